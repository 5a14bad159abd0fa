#!/usr/bin/env python3
"""The package of fovead on the emulated board: package_on_board.py PACKAGE.deb USB_CAMERA [WORD...]

PACKAGE.deb is of arm64, USB_CAMERA is usb_camera.cpp compiled for the board. dpkg of Debian installs it, and what it brought is run: the modes that fovea probe tells are
those of v4l2-ctl, fovea doctor finds nothing, fovead judges by the settings that were installed, and what it asks of
the kernel is what the filter of its service lets through.
"""
import contextlib
import json
import re
import subprocess
import sys
import tempfile
from pathlib import Path

from cases import case, holds, run_cases, same
from daemon_rig import RECIPE
from emulated_board import EmulatedBoard

PACKAGE, USB_CAMERA = (Path(word).resolve() for word in sys.argv[1:3])
ROOT = Path(__file__).resolve().parents[2]
UNIT = ROOT / "apps/fovead/fovead.service"
# The dpkg of busybox knows no conffiles.
INSTALL = """
set -e
touch /var/lib/dpkg/status
install_package() { /usr/bin/dpkg --force-bad-path -i /test/fovead.deb > /tmp/dpkg 2>&1 || { cat /tmp/dpkg >&2; exit 3; }; }
install_package
cp /test/disc.toml /etc/fovea/jobs
part() { echo "== $1"; }
"""
# What a person changes in the settings that were installed.
SETTINGS = """
sed -i 's,^device = "auto",device = "path:vivid.0",; s,^pixel_format = .*,pixel_format = "gray8",' /etc/fovea/fovead.toml
sed -i 's,^width = 0,width = 640,; s,^height = 0,height = 360,' /etc/fovea/fovead.toml
sed -i 's,^chip = "",chip = "pl061",; s,^ok = "",ok = "5",; s,^ng = "",ng = "6",' /etc/fovea/fovead.toml
"""
# Until the daemon has said something: its output is a file, for a pipe would want a reader.
SAYS = """
says() { tries=0; until grep -q "$1" /tmp/said; do sleep 0.1; tries=$((tries + 1)); [ $tries -lt 300 ] || { cat /tmp/said /tmp/complaints >&2; exit 4; }; done; }
"""


@contextlib.contextmanager
def booted(script, packages=(), fetch=(), **options):
    """What a script said on a board with the package, part by part; and the folder of what was fetched."""
    with tempfile.TemporaryDirectory() as folder:
        recipe = Path(folder) / "disc.toml"
        recipe.write_text(RECIPE)
        files = {"/test/fovead.deb": PACKAGE, "/test/disc.toml": recipe, "/test/usb_camera": USB_CAMERA}
        with EmulatedBoard(["sh", "-c", INSTALL + script], files=files, packages=["dpkg", "tar", *packages],
                           fetch={name: f"{folder}/{name.strip('/')}" for name in fetch}, seconds=120,
                           **options) as board:
            status = board.wait()
            if (status, board.trouble) != (0, ""):
                said = (board.stdout.everything() + board.stderr.everything()).decode()
                raise AssertionError(f"the script ended with {status}: {said}{board.trouble}")
            parts = re.split(r"^== (.*)\n", board.stdout.everything().decode(), flags=re.M)
            yield dict(zip(parts[1::2], parts[2::2])), Path(folder)


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


@case
def probe_tells_what_v4l2_ctl_tells():
    script = """
part probe; fovea probe --json
part text; fovea probe --size 640x360 --format gray8
part formats; v4l2-ctl -d /dev/video0 --list-formats-ext
part controls; v4l2-ctl -d /dev/video0 --list-ctrls
part camera; v4l2-ctl -d /dev/video0 --info
"""
    with booted(script, packages=["v4l-utils"], cameras=1, serial=["socket"]) as (parts, _):
        devices = [json.loads(line) for line in parts["probe"].splitlines()]
        cameras = [device for device in devices if device["device"] == "camera"]
        same([(camera["node"], camera["pictures"]) for camera in cameras], [("/dev/video0", True)])
        same(cameras[0]["identity"], "path:vivid.0")
        ours = [[mode["code"], mode["width"], mode["height"], mode["interval_us"]] for mode in cameras[0]["modes"]]
        theirs = modes_of_v4l2_ctl(parts["formats"])
        unread = {text.split(" ")[0] for text in cameras[0]["not_read"]}
        # A millisecond is what v4l2-ctl rounds to.
        same([mode[:3] for mode in ours], [mode[:3] for mode in theirs if mode[0] not in unread])
        same([], [(our, their) for our, their in zip(ours, (mode for mode in theirs if mode[0] not in unread))
                  if abs(our[3] - their[3]) > 1000])
        same(len(ours) > 10, True)
        controls = {control["name"]: control for control in cameras[0]["controls"]}
        listed = re.findall(r"^\s*(\w+) 0x\w+ \((?:int|bool|menu)\) +: (?:min=(-?\d+) max=(-?\d+) step=(\d+) )?"
                            r".*?default=(-?\d+) value=(-?\d+)(.*)", parts["controls"], re.M)
        same(len(listed) > 10, True)
        for name, least, most, step, otherwise, now, flags in listed:
            ours = controls[name]
            same((name, ours["default"]), (name, int(otherwise)))
            same((name, ours["inactive"]), (name, "inactive" in flags))
            if "volatile" not in flags:  # it changes by itself
                same((name, ours["now"]), (name, int(now)))
            if least:
                same((name, ours["from"], ours["to"], ours["step"]), (name, int(least), int(most), int(step)))
        holds(parts["camera"], cameras[0]["card"])
        holds(parts["text"], "chosen: gray8 (GREY) 640x360 at ")
        chips = [device for device in devices if device["device"] == "gpio"]
        same([chip["label"] for chip in chips], ["9030000.pl061"])
        same(len(chips[0]["lines"]), 8)
        same([device["node"] for device in devices if device["device"] == "serial"].count("/dev/ttyS0"), 1)


@case
def probe_tells_a_node_without_pictures_and_a_range_of_sizes():
    script = "part probe; fovea probe --format gray8 --size 1280x720\n"
    with booted(script, cameras=1, loop=True) as (parts, _):
        holds(parts["probe"], "\n  gray8       GREY  16x16 to 16384x8640 in steps of ")
        holds(parts["probe"], "chosen: gray8 (GREY) 1280x720 at 60 frames/s")
        holds(parts["probe"], "/dev/video1: vivid (vivid, platform:vivid-000): no pictures: this node gives no pictures")


@case
def a_camera_of_usb_is_named_by_its_identity_and_keeps_its_exposure():
    script = """
/test/usb_camera > /tmp/usb & until [ -e /dev/video1 ]; do sleep 0.1; done
part probe; fovea probe --json
cat >> /etc/fovea/fovead.toml << END
[[control]]
name = "exposure_time_absolute"
value = 123
[[control]]
name = "auto_exposure"
value = 1
END
sed -i 's,^device = "auto",device = "usb:1209:0001:0001",' /etc/fovea/fovead.toml
part doctor; fovea doctor || echo "status $?"
part after; v4l2-ctl -d /dev/video0 --get-ctrl=exposure_time_absolute,auto_exposure
sed -i 's,^value = 123,value = 5001,' /etc/fovea/fovead.toml
part wrong; fovea doctor || echo "status $?"
"""
    with booted(script, packages=["v4l-utils"], modules=["vhci-hcd", "uvcvideo"]) as (parts, _):
        cameras = [json.loads(line) for line in parts["probe"].splitlines() if '"camera"' in line]
        same([(camera["identity"], camera["pictures"]) for camera in cameras],
             [("usb:1209:0001:0001", True), ("/dev/video1", False)])
        controls = {control["name"]: control for control in cameras[0]["controls"]}
        same(controls["exposure_time_absolute"]["inactive"], True)
        same(re.findall(r"^FAIL.*", parts["doctor"], re.M), [])
        holds(parts["doctor"], "ok    controls  2 set, and the camera has kept them\n")
        same(parts["after"], "exposure_time_absolute: 123\nauto_exposure: 1 (Manual Mode)\n")
        holds(parts["wrong"], "exposure_time_absolute = 5001: it takes 1 to 5000 in steps of 1\n")
        same("stream" in parts["wrong"], False)
        holds(parts["wrong"], "status 1\n")


@case
def the_daemon_runs_by_the_settings_that_were_installed():
    script = SETTINGS + SAYS + """
part check; fovead --check-config
fovead > /tmp/said 2> /tmp/complaints & daemon=$!
says '"ev":"result"'
part busy; fovea doctor || echo "status $?"
part held; fovea probe --json
kill $daemon; part end; wait $daemon || echo "status $?"
part said; cat /tmp/said
part doctor; fovea doctor && echo "status 0"
part json; fovea doctor --json --frames 10
part again; install_package; grep -c pl061 /etc/fovea/fovead.toml
/usr/bin/dpkg --force-bad-path -r fovead > /tmp/dpkg 2>&1
ls /usr/bin/fovead /etc/fovea/fovead.toml 2> /dev/null || true
part purged; /usr/bin/dpkg --force-bad-path -P fovead > /tmp/dpkg 2>&1; cat /tmp/dpkg; ls -d /etc/fovea/fovead.toml /var/lib/fovead 2> /dev/null || true
"""
    with booted(script, cameras=1) as (parts, _):
        same(parts["check"], "/etc/fovea/fovead.toml: good, 1 jobs\n")
        events = [json.loads(line) for line in parts["said"].splitlines()]
        same((events[0]["ev"], events[0]["camera"], events[0]["width"]), ("start", "/dev/video0", 640))
        same([event["job"] for event in events if event["ev"] == "result"][0], "disc")
        holds(parts["busy"], "open in fovead (process ")
        holds(parts["busy"], "try: sudo systemctl stop fovead, and look again")
        holds(parts["busy"], "is held by fovea")
        holds(parts["busy"], "status 1\n")
        chip = [json.loads(line) for line in parts["held"].splitlines() if '"gpio"' in line][0]
        same([(line["line"], line["held_by"]) for line in chip["lines"] if line["held_by"]],
             [(5, "fovea:ok"), (6, "fovea:ng")])
        same(parts["end"], "")
        same(re.findall(r"^(?:FAIL|warn) .*", parts["doctor"], re.M), [])
        holds(parts["doctor"], "status 0\n")
        checks = {check["check"]: check for check in map(json.loads, parts["json"].splitlines())}
        same(sorted(checks), ["camera", "controls", "frames", "jobs", "light", "lines", "mode", "settings", "stamps",
                              "stream"])
        # The settings wish for 10 a second at least, and vivid sends its highest rate or what was asked for.
        same(9000 < checks["frames"]["interval_us"] < 110000, True)
        same(parts["again"], "1\n/etc/fovea/fovead.toml\n")  # kept when the package comes again, and when it goes
        same("/etc/fovea/fovead.toml" in parts["purged"].splitlines(), False)


@case
def the_first_measurement_of_the_page_is_one():
    lines = re.search(r"```sh\n(.*?)```", (ROOT / "docs/daemon.md").read_text(), re.S)[1]
    install, _, rest = lines.partition("\n")
    same((install, rest.count("\n")), ("sudo dpkg -i fovead_0.1.0_arm64.deb", 9))
    script = f"""
rm /etc/fovea/jobs/disc.toml  # the page brings its own
cd /tmp
sudo() {{ "$@"; }}
systemctl() {{ [ "$*" = "start fovead" ]; fovead > /tmp/said 2> /tmp/complaints & }}
journalctl() {{ says '"ev":"result"'; part journal; head -n 3 /tmp/said; }}
# A dark square on white: a part that can be taught.
v4l2-ctl -d /dev/video0 --set-ctrl=test_pattern=6,osd_text_mode=2,show_square=1
{SAYS}
part page
{rest}"""
    with booted(script, packages=["v4l-utils"], cameras=1) as (parts, _):
        holds(parts["page"], "chosen: gray8 (GREY) ")
        holds(parts["page"], "1 good part, dark on bright")
        same(re.findall("^FAIL.*", parts["page"], re.M), [])
        result = [event for event in map(json.loads, parts["journal"].splitlines()) if event["ev"] == "result"][0]
        same((result["job"], result["verdict"], result["values"][0]), (
            "part", "OK", {"name": "length", "value": 256.0, "verdict": "ok"}))


def allowed_calls():
    """What the filters of the unit let through, by the sets of systemd on this machine."""
    sets, name = {}, None
    for line in subprocess.run(["systemd-analyze", "syscall-filter", "--no-pager"], capture_output=True, text=True,
                               check=True).stdout.split("\n"):
        if line.startswith("@"):
            name = line.strip()
            sets[name] = set()
        elif name and (word := line.strip()) and not word.startswith("#"):
            sets[name].add(word)

    def expand(word):
        return set().union(*map(expand, sets[word])) if word.startswith("@") else {word}
    allowed = set()
    for line in UNIT.read_text().split("\n"):
        if found := re.fullmatch(r"SystemCallFilter=(~?)(.*)", line):
            named = set().union(*map(expand, found[2].split()))
            allowed = allowed - named if found[1] else allowed | named
    return allowed


@case
def the_filter_of_the_service_lets_through_what_the_daemon_asks_for():
    script = SETTINGS + SAYS + """
sed -i 's,^device = "",device = "/dev/ttyS0",' /etc/fovea/fovead.toml
sed -i 's,^source = .*,source = "line",; s,^line = "",line = "0",' /etc/fovea/fovead.toml
mkdir /var/lib/fovead
strace -f -o /trace fovead --config /etc/fovea/fovead.toml > /tmp/said 2> /tmp/complaints & tracer=$!
says '"ev":"start"'
daemon=$(pidof fovead)
kill -HUP $daemon
says '"ev":"reload"'
kill $daemon; wait $tracer
"""
    with booted(script, packages=["strace"], cameras=1, serial=["socket"], fetch=["/trace"]) as (_, folder):
        trace = (folder / "trace").read_text()
        calls = set(re.findall(r"^\d+ +(\w+)\(", trace, re.M))
        same({"ioctl", "mmap", "ppoll"} <= calls, True)
        same(sorted(calls - allowed_calls()), [])
        # As MemoryDenyWriteExecute= and RestrictAddressFamilies= want it.
        same(re.findall(r"^.*PROT_WRITE\|PROT_EXEC.*", trace, re.M), [])
        same([line for line in re.findall(r"^.*socket\(.*", trace, re.M) if "AF_UNIX" not in line], [])


sys.exit(run_cases("package_on_board", sys.argv[3:]))
