#!/usr/bin/env python3
"""The package of fovead under systemd, on the emulated board: service_test.py PACKAGE.deb PROGRAMS [--figures FILE] [WORD...]

PACKAGE.deb is of arm64, PROGRAMS is the folder of the programs that were compiled for the board. A person installs the
package with Debian's dpkg and does what docs/daemon.md says; systemd runs the service, udev gives it its devices. What
hangs is ended by the watchdog.
"""
import json
import re
import subprocess
import sys
import tempfile
from pathlib import Path

from cases import case, holds, run_cases, same
from daemon_rig import ALARM, BUSY, NG, OK, READY, TRIGGER, VALID
from emulated_board import EmulatedBoard
from faults_page import IN_SERVICE
from service_rig import HOME, ServiceRig
from watched import unlike_the_page

PACKAGE, PROGRAMS = (Path(word).resolve() for word in sys.argv[1:3])
ROOT = Path(__file__).resolve().parents[2]
NAMES = {"ready": READY, "busy": BUSY, "valid": VALID, "ok": OK, "ng": NG, "alarm": ALARM}
# vivid then shows a dark square on white: a part that can be taught.
SQUARE = "v4l2-ctl -d /dev/video0 --set-ctrl=test_pattern=6,osd_text_mode=2,show_square=1"
JOB = """format = 1
name = "square"
[locate]
part = "dark"
threshold = "otsu"
orientation = "none"
area_min = 1000
hole_area_min = 100
[[feature]]
name = "holes"
kind = "hole_count"
nominal = 0
minus = 0
plus = 0
"""
# In place of the 10 s of the service, where that is not what is looked at.
SHORT_S = 3
figures = {}


# A call that the unit forbids would be an error, which a port may get along with.
KILL = "[Service]\nSystemCallErrorNumber=kill\n"


def rig(**options):
    """With a job for what vivid shows, the programs that cases ask for, and a filter that nothing slips through."""
    texts = {f"{HOME}/square.toml": JOB, "/etc/systemd/system/fovead.service.d/kill.conf": KILL}
    files = {f"/board/{name}": PROGRAMS / name for name in ("hanging_fovead", "usb_camera")}
    files["/bin/count_calls"] = PROGRAMS / "count_calls"
    return ServiceRig(PACKAGE, texts, files=files, **options)


def at_most(value, limit, what):
    if value > limit:
        raise AssertionError(f"{what}: {value}, more than {limit}")


def nothing_failed(doctor):
    same(re.findall(r"^(?:FAIL|warn).*\n.*", doctor, re.M), [])


def lines_of_the_page():
    lines = re.search(r"```sh\n(.*?)```", (ROOT / "docs/daemon.md").read_text(), re.S)[1].splitlines()
    same((len(lines), lines[0], lines[-1]), (
        10, "sudo dpkg -i fovead_0.1.0_arm64.deb", "sudo journalctl -u fovead -o cat -f"))
    return lines


def wire(board, **trigger):
    """Gives the daemon its lines, as a person does."""
    board.change("lines", chip='"pl061"', **{name: f'"{line}"' for name, line in NAMES.items()})
    if trigger:
        board.change("trigger", **trigger)


def has_rights_of_its_own(board):
    """The daemon is not root, and what it works with is its groups'."""
    user = board.must("id -u fovead")[0]
    status = dict(line.split(":", 1) for line in board.must("cat /proc/$(pidof fovead)/status"))
    same((user != "0", set(status["Uid"].split())), (True, {user}))
    groups = {line.split(":")[2]: line.split(":")[0] for line in board.must("cat /etc/group")}
    same({groups[number] for number in status["Groups"].split()}, {"fovead", "video", "dialout", "gpio"})
    for node, group in (("/dev/gpiochip0", "gpio"), ("/dev/video0", "video"), ("/dev/ttyS0", "dialout")):
        same(board.must(f"ls -l {node}")[0].split()[:4], ["crw-rw----", "1", "root", group])


def stops_within_a_second(board):
    """All lines are inactive, and systemd is content."""
    board.must("sudo systemctl stop fovead")
    shown = board.shown("Result", "ExecMainStatus", "NRestarts", "ExecMainExitTimestampMonotonic")
    us = int(shown.pop("ExecMainExitTimestampMonotonic")) - board.told_us("Stopping ")
    figures["systemctl stop: until the daemon has ended"] = f"{us // 1000} ms"
    at_most(us, 1000000, "microseconds of stopping")
    same(set(board.pins.outputs().values()), {0})
    same(shown, {"Result": "success", "ExecMainStatus": "0", "NRestarts": "0"})


@case
def the_first_measurement_of_the_page_is_one():
    with rig(cameras=1, serial=["socket"]) as board:
        board.must(SQUARE)
        said = ""
        for line in lines_of_the_page()[:-1]:
            said += board.text(line)
        board.follow(lines_of_the_page()[-1])
        holds(said, "chosen: gray8 (GREY) ")
        holds(said, "1 good part, dark on bright")
        nothing_failed(said)
        result = board.event("result")
        same((result["job"], result["verdict"], result["values"][0]), (
            "part", "OK", {"name": "length", "value": 256.0, "verdict": "ok"}))
        has_rights_of_its_own(board)
        holds(board.text("sudo fovea doctor || true"), "try: sudo systemctl stop fovead, and look again")

        # Lines and a serial port, and then a job that this part fails.
        wire(board)
        board.change("serial", device='"/dev/ttyS0"')
        board.change("failures", folder='"/var/lib/fovead"')
        board.must("sudo systemctl reload fovead")
        board.event("reload")
        same(board.pins.wait_for(OK, 1), True)
        board.must("sudo sed -i '/^kind = \"hole_count\"/,$ s/^nominal = 0/nominal = 1/' /etc/fovea/jobs/part.toml")
        board.must("sudo systemctl reload fovead")
        board.event("reload")
        same(board.pins.wait_for(NG, 1), True)
        result = board.event("result")
        same((result["verdict"], result["feature"]), ("NG", "holes"))
        comes_on_the_serial_line(board, "OK", "NG")
        told = board.text("sudo systemctl status fovead")
        holds(told, "Active: active (running)")
        same(re.findall(r'Status: "(part: \d+ OK, \d+ NG, \d+ ERROR, 0 missed)"', told) != [], True)
        a_sample_becomes_a_job(board)
        # systemd forgets what became of a service that nobody wants.
        board.must("sudo systemctl enable fovead 2> /dev/null")

        board.install()
        board.event("start")  # it ran, so the new one runs
        holds(board.text("cat /etc/fovea/fovead.toml"), "pl061")
        stops_within_a_second(board)
        holds(board.text("sudo ls /var/lib/fovead"), ".pgm")
        nothing_failed(board.text("sudo -u fovead fovea doctor"))
        goes_and_is_purged(board)


def a_sample_becomes_a_job(board):
    """What TEACH keeps, in a folder that was not there, by the lines of the page."""
    board.change("teach", folder='"/var/lib/fovead/samples"')
    board.must("sudo systemctl reload fovead")
    board.event("reload")
    board.board.serial[0].sendall(b"TEACH cap\n")
    sample = board.event("sample", "sample_lost")
    same((sample["ev"], sample["name"], sample.get("reason")), ("sample", "cap", None))
    page = (ROOT / "docs/daemon.md").read_text()
    for line in re.search(r"```sh\n(sudo sh -c 'fovea teach.*?)```", page, re.S)[1].splitlines():
        board.must(line)
    board.event("reload")
    same(board.must("fovead --check-config"), ["/etc/fovea/fovead.toml: good, 2 jobs"])


def comes_on_the_serial_line(board, *verdicts):
    """Lines with these come, in this order, whatever is between them."""
    board.board.serial[0].settimeout(5)
    text = b""
    for verdict in verdicts:
        while f"{verdict}\r\n".encode() not in text:
            text += board.board.serial[0].recv(4096)
        text = text.partition(f"{verdict}\r\n".encode())[2]


def goes_and_is_purged(board):
    same(board.must("sudo systemctl is-enabled fovead"), ["enabled"])
    board.must("sudo systemctl start fovead")
    board.text("sudo dpkg -r fovead 2>&1")
    same(board.run("pidof fovead")[0], 1)
    same(set(board.pins.outputs().values()) - {0}, set())
    wants = "/etc/systemd/system/multi-user.target.wants/fovead.service"
    same(board.must(f"ls /usr/bin/fovead /etc/fovea/fovead.toml {wants} 2> /dev/null || true"), ["/etc/fovea/fovead.toml"])
    board.text("sudo dpkg -P fovead 2>&1")
    same(board.must("ls -d /etc/fovea/fovead.toml /var/lib/fovead 2> /dev/null || true"), [])


# ---- Faults --------------------------------------------------------------------------------


def begin(board):
    """Installs the package and starts the service: triggers by a line, verdicts on lines and on a serial port."""
    board.must(SQUARE)
    board.install()
    board.must("sudo cp square.toml /etc/fovea/jobs")
    board.change("camera", width=640, height=360, pixel_format='"gray8"')
    board.change("serial", device='"/dev/ttyS0"')
    wire(board, source='"line"', line=f'"{TRIGGER}"')
    board.follow()
    board.must("sudo systemctl start fovead")
    same(board.pins.wait_for(READY, 1), True)
    good_part(board)


def pulse(board):
    board.pins.drive(TRIGGER, 1)
    board.pins.drive(TRIGGER, 0)


def good_part(board):
    """A trigger's result, when the daemon is ready for another."""
    pulse(board)
    result = board.event("result")
    same((result["verdict"], result["why"]), ("OK", None))
    same(board.pins.wait_for(READY, 1), True)
    return result


def comes_back(board, active, limit, what, hung_us):
    """The line that is active becomes inactive as all others and nothing is shown as judged; systemd starts the daemon
    again within the limit, and it judges."""
    seen = board.pins.changes_until(active, 0, seconds=60)
    if seen is None:
        raise AssertionError(f"{what}: nobody has ended it, and its lines stay as they are")
    board.event("start")
    started_us = int(board.shown("ExecMainStartTimestampMonotonic")["ExecMainStartTimestampMonotonic"])
    safe_us = board.told_us("fovead.service: Failed with result")  # the end of what the service does then
    at_most((started_us - hung_us) / 1000000, limit, f"seconds until it was started again, {what}")
    seen += board.pins.changes()
    same([change for change in seen if change in ((OK, 1), (NG, 1), (VALID, 1))], [])
    same((READY, 1) in seen or board.pins.wait_for(READY, 1), True)
    same({board.pins.outputs()[line] for line in (OK, NG, VALID, BUSY)}, {0})
    result = good_part(board)
    board.hold()
    figures[f"F28: {what}: until its lines were safe"] = f"{(safe_us - hung_us) // 1000} ms"
    figures[f"F28: {what}: until it was started again"] = f"{(started_us - hung_us) // 1000} ms"
    figures[f"F28: {what}: until its first verdict"] = f"{(result['t_mono_us'] - hung_us) // 1000} ms"


def hangs(board, kind, number):
    """Another life of the daemon, in which a call will never come back."""
    board.must(f"echo 'FOVEA_HANG={kind} {number} /var/lib/fovead/{kind}' | sudo tee /etc/fovea/hang")
    board.must("sudo systemctl restart fovead")
    same(board.pins.wait_for(READY, 1), True)


def lets_calls_hang(board):
    """From the next start on the program is the one whose calls may hang."""
    unit = ("[Service]\\nExecStart=\\nExecStart=/board/hanging_fovead --config /etc/fovea/fovead.toml\\n"
            f"EnvironmentFile=/etc/fovea/hang\\nWatchdogSec={SHORT_S}\\n")
    board.must(f"printf '{unit}' | sudo tee /etc/systemd/system/fovead.service.d/hang.conf")
    board.must("sudo systemctl daemon-reload")


@case
def a_daemon_that_hangs_is_started_again_with_its_lines_safe():
    with rig(cameras=1, serial=["socket"], steady=True) as board:
        begin(board)
        same(board.shown("WatchdogUSec", "Restart", "TimeoutStopUSec"),
             {"WatchdogUSec": "10s", "Restart": "always", "TimeoutStopUSec": "5s"})
        board.hold()
        board.provoke("F28")
        # The daemon as it is shipped: all of it stands still.
        board.pins.changes()
        stopped = float(board.must("sudo kill -STOP $(pidof fovead); cut -d ' ' -f 1 /proc/uptime")[0])
        comes_back(board, READY, 10 + 2, "stopped as a whole by SIGSTOP, WatchdogSec=10", int(stopped * 1000000))
        same(board.shown("NRestarts"), {"NRestarts": "1"})

        # One stage of it, the rest as it is: a frame is asked for and none comes, nor an error.
        lets_calls_hang(board)
        hangs(board, "frame", 30)
        hung = board.event("hangs")
        comes_back(board, READY, SHORT_S + 2, f"a call for a frame hangs, WatchdogSec={SHORT_S}", hung["t_mono_us"])

        # The line of a verdict: six are made inactive, then ready; a whole trigger has 6 changes, and with the
        # next ready, valid and ok end, and busy begins. So the 18th would have been OK.
        hangs(board, "line", 18)
        good_part(board)
        pulse(board)
        hung = board.event("hangs")
        outputs = board.pins.outputs()
        same([outputs[line] for line in (READY, BUSY, VALID, OK, NG)], [0, 1, 0, 0, 0])
        board.pins.changes()
        comes_back(board, BUSY, SHORT_S + 2, f"setting a line hangs, WatchdogSec={SHORT_S}", hung["t_mono_us"])

        # The serial port, while a person ends the service: the second record hangs.
        board.count_calls_after()
        # Whoever hangs cannot tell of it: systemd has, once for each.
        same(board.text("sudo journalctl -u fovead -o cat --no-pager").count("Failed with result 'watchdog'"), 3)
        hangs(board, "serial", 2)
        good_part(board)
        pulse(board)
        board.event("hangs")
        board.must("sudo systemctl stop fovead")
        same(set(board.pins.outputs().values()), {0})


# ---- Devices -------------------------------------------------------------------------------


def modes_of_v4l2_ctl(text):
    """(code, width, height, microseconds at the highest rate) of what --list-formats-ext says."""
    modes, code, size = [], None, None
    for line in text.split("\n"):
        if found := re.search(r"\[\d+\]: '(.{4}(?:-BE)?)'", line):
            code = found[1].replace(" ", "")
        elif found := re.search(r"Size: Discrete (\d+)x(\d+)", line):
            size = (code, int(found[1]), int(found[2]))
            modes.append([*size, 0])
        elif found := re.search(r"Interval: Discrete ([\d.]+)s", line):
            us = round(float(found[1]) * 1000000)
            if modes[-1][3] == 0 or us < modes[-1][3]:
                modes[-1][3] = us
    return modes


def modes_are_those_of_v4l2_ctl(board, camera):
    ours = [[mode["code"], mode["width"], mode["height"], mode["interval_us"]] for mode in camera["modes"]]
    unread = {text.split(" ")[0] for text in camera["not_read"]}
    listed = modes_of_v4l2_ctl(board.text("v4l2-ctl -d /dev/video0 --list-formats-ext"))
    theirs = [mode for mode in listed if mode[0] not in unread]
    same([mode[:3] for mode in ours], [mode[:3] for mode in theirs])
    # A millisecond is what v4l2-ctl rounds to.
    same([(our, their) for our, their in zip(ours, theirs) if abs(our[3] - their[3]) > 1000], [])
    same(len(ours) > 10, True)


def controls_are_those_of_v4l2_ctl(board, camera):
    controls = {control["name"]: control for control in camera["controls"]}
    listed = re.findall(r"^\s*(\w+) 0x\w+ \((?:int|bool|menu)\) +: (?:min=(-?\d+) max=(-?\d+) step=(\d+) )?"
                        r".*?default=(-?\d+) value=(-?\d+)(.*)", board.text("v4l2-ctl -d /dev/video0 --list-ctrls"), re.M)
    same(len(listed) > 10, True)
    for name, least, most, step, otherwise, now, flags in listed:
        ours = controls[name]
        same((name, ours["default"]), (name, int(otherwise)))
        same((name, ours["inactive"]), (name, "inactive" in flags))
        if "volatile" not in flags:  # it changes by itself
            same((name, ours["now"]), (name, int(now)))
        if least:
            same((name, ours["from"], ours["to"], ours["step"]), (name, int(least), int(most), int(step)))


@case
def probe_tells_what_there_is_and_udev_names_a_camera():
    with rig(cameras=1, serial=["socket"], modules=["vhci-hcd", "uvcvideo"]) as board:
        board.install()

        def probed():
            devices = [json.loads(line) for line in board.must("sudo fovea probe --json | sed 's/^/ /'")]
            return [[device for device in devices if device["device"] == kind] for kind in ("camera", "gpio", "serial")]
        (camera,), (chip,), ports = probed()
        same((camera["node"], camera["pictures"], camera["identity"]), ("/dev/video0", True, "path:vivid.0"))
        holds(board.text("v4l2-ctl -d /dev/video0 --info"), camera["card"])
        modes_are_those_of_v4l2_ctl(board, camera)
        controls_are_those_of_v4l2_ctl(board, camera)
        holds(board.text("fovea probe --size 640x360 --format gray8"), "chosen: gray8 (GREY) 640x360 at ")
        same((chip["label"], len(chip["lines"])), ("9030000.pl061", 8))
        same([port["node"] for port in ports].count("/dev/ttyS0"), 1)

        # A camera is plugged in; then it is gone, and its name too.
        board.tell("sudo /board/usb_camera > usb 2>&1 &")
        board.must("until [ -e /dev/fovea/cam-0001 ]; do sleep 0.1; done")
        same(board.must("readlink -f /dev/fovea/cam-0001"), ["/dev/video1"])
        same(board.must("ls -l /dev/video1")[0].split()[:4], ["crw-rw----", "1", "root", "video"])
        same([(camera["node"], camera["identity"], camera["pictures"]) for camera in probed()[0]][1:], [
            ("/dev/video1", "usb:1209:0001:0001", True), ("/dev/video2", "/dev/video2", False)])
        keeps_its_exposure(board)
        board.must("sudo pkill usb_camera; until [ ! -e /dev/fovea/cam-0001 ]; do sleep 0.1; done")


def keeps_its_exposure(board):
    """A control that another one keeps from being set."""
    board.must("sudo cp square.toml /etc/fovea/jobs")
    board.change("camera", device='"usb:1209:0001:0001"')
    board.must("printf '[[control]]\nname = \"exposure_time_absolute\"\nvalue = 123\n"
               "[[control]]\nname = \"auto_exposure\"\nvalue = 1\n' | sudo tee -a /etc/fovea/fovead.toml")
    doctor = board.run("fovea doctor")[1]
    same([line for line in doctor if line.startswith("FAIL")], [])
    same("ok    controls  2 set, and the camera has kept them" in doctor, True)
    same(board.must("v4l2-ctl -d /dev/video1 --get-ctrl=exposure_time_absolute,auto_exposure"),
         ["exposure_time_absolute: 123", "auto_exposure: 1 (Manual Mode)"])
    board.must("sudo sed -i 's,^value = 123,value = 5001,' /etc/fovea/fovead.toml")
    status, doctor = board.run("fovea doctor")
    same((status, "stream" in "".join(doctor)), (1, False))
    holds("".join(doctor), "exposure_time_absolute = 5001: it takes 1 to 5000 in steps of 1")


@case
def probe_tells_a_node_without_pictures_and_a_range_of_sizes():
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run(["dpkg-deb", "-x", PACKAGE, folder], check=True)
        with EmulatedBoard(["fovea", "probe", "--format", "gray8", "--size", "1280x720"],
                           files={"/usr/bin/fovea": f"{folder}/usr/bin/fovea"}, cameras=1, loop=True) as board:
            same((board.wait(), board.trouble), (0, ""))
            told = board.stdout.everything().decode()
    holds(told, "\n  gray8       GREY  16x16 to 16384x8640 in steps of ")
    holds(told, "chosen: gray8 (GREY) 1280x720 at 60 frames/s")
    holds(told, "/dev/video1: vivid (vivid, platform:vivid-000): no pictures: this node gives no pictures")


if __name__ == "__main__":
    words = sys.argv[3:]
    path = words[words.index("--figures") + 1] if "--figures" in words else None
    if path is not None:
        at = words.index("--figures")
        words[at:at + 2] = []
    status = run_cases("service_test", words)
    status = status or unlike_the_page(IN_SERVICE, not words)
    for name in sorted(figures):
        print(f"  {name}: {figures[name]}")
    if path is not None:
        Path(path).write_text("".join(f"{name} = {figures[name]}\n" for name in sorted(figures)))
    sys.exit(status)
