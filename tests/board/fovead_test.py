#!/usr/bin/env python3
"""The daemon on the emulated board, seen from outside: fovead_test.py PROGRAMS [--figures FILE] [WORD...]

PROGRAMS is the folder of the programs that were compiled for the board. Cameras, serial lines and pins are those of the
kernel; pictures go in through them, and what comes out is read on the other end of the lines.
"""
import statistics
import sys
import time

from cases import case, holds, run_cases, same
from daemon_rig import (ALARM, BUSY, BY_COMMAND, BY_LINE, LINES, NG, OK, READY, SERIAL, TRIGGER, USB, VALID, VIVID,
                        DaemonRig)

PROGRAMS = sys.argv[1]
figures = {}


def rig(settings, **options):
    return DaemonRig(PROGRAMS, settings, **options)


def at_most(value, limit, what):
    if value > limit:
        raise AssertionError(f"{what}: {value}, more than {limit}")


def judged(result, verdict):
    same((result["verdict"], result["why"] if verdict == "OK" else None), (verdict, None))


def heard(board, count, seconds=5):
    """So many lines of the serial port's other end."""
    text, end = b"", time.monotonic() + seconds
    board.serial[0].settimeout(0.2)
    while text.count(b"\n") < count and time.monotonic() < end:
        try:
            text += board.serial[0].recv(4096)
        except TimeoutError:
            pass
    return text.decode().split("\r\n")[:-1]


@case
def verdicts_come_out_on_lines_serial_and_as_json():
    with rig(VIVID + BY_LINE + LINES + SERIAL, cameras=1, loop=True, serial=["socket"]) as board:
        board.show("good")
        start = board.start()
        same((start["camera"], start["format"], start["width"]), ("/dev/video0", "gray8", 640))
        same(board.pins.wait_for(READY, 1), True)
        first = board.trigger()
        same((first["verdict"], first["why"], first["parts"]), ("OK", None, 1))
        same(board.pins.wait_for(READY, 1), True)
        board.pins.changes()
        board.trigger()
        same(board.pins.wait_for(READY, 1), True)
        board.show("bad")
        board.pins.changes()
        board.pins.drive(TRIGGER, 1)
        same(board.event("result")["feature"], "holes")
        board.pins.drive(TRIGGER, 0)
        time.sleep(0.2)
        # The answer before is gone first; the line of the new one comes before valid, and busy ends last.
        same(board.pins.changes(), [(READY, 0), (VALID, 0), (OK, 0), (BUSY, 1), (NG, 1), (VALID, 1), (BUSY, 0), (READY, 1)])
        same([line.split(";")[:2] for line in heard(board.board, 3)], [["1", "OK"], ["2", "OK"], ["3", "NG"]])
        times = []
        for _ in range(30):
            times.append(board.trigger()["us"]["answer"])
            board.pins.wait_for(READY, 1)
        figures["from the trigger's edge to the answer, median of 30"] = f"{int(statistics.median(times))} us"
        figures["from the trigger's edge to the answer, the most of 30"] = f"{max(times)} us"
        board.board.serial[0].sendall(b"#9 stat?\r\n")
        same(heard(board.board, 31)[-1].split(" us ")[0], "#9 OK triggers 33 ok 2 ng 31 error 0 missed 0")
        board.pins.changes()
        status, seconds = board.stop()
        same(status, 0)
        at_most(seconds, 1, "SIGTERM ends it within a second")
        same(set(board.pins.outputs().values()) - {0}, set())
        same(board.run("cat /tmp/complaints"), (0, []))


@case
def a_usb_camera_that_was_unplugged_is_found_again():
    camera = "usb_camera --grey /test/good.gray --port {} > /dev/null & camera=$!"
    # The camera is software too, and shares the processor.
    with rig(USB + BY_LINE + "timeout_ms = 5000\n" + LINES, cameras=0, modules=["vhci-hcd", "uvcvideo"]) as board:
        board.tell(camera.format(0))
        board.run("until [ -e /dev/video1 ]; do sleep 0.05; done")
        same(board.start()["camera"], "/dev/video0")
        same(board.pins.wait_for(READY, 1), True)
        judged(board.trigger(), "OK")
        back = []
        for port in (1, 0, 3):
            board.run("kill $camera; wait $camera")
            board.event("camera_lost")
            same(board.pins.wait_for(ALARM, 1), True)
            same(board.trigger()["why"], "no_camera")
            board.tell(camera.format(port))
            back.append(board.event("camera_back")["after_us"])
            same(board.pins.wait_for(READY, 1), True)
            judged(board.trigger(), "OK")
        same(board.stop()[0], 0)
        same(board.run("ls /proc/$daemon 2>/dev/null | wc -l")[1], ["0"])


@case
def what_is_wrong_at_the_start_is_said_in_a_line():
    with rig(VIVID + BY_COMMAND + LINES + SERIAL, cameras=1, serial=["socket"], modules=["gpio-keys"]) as board:
        start = "fovead --config {} 2>&1 > /dev/null < /dev/null"
        same(board.run(start.format("/nowhere")), (78, ["fovead: /nowhere: No such file or directory"]))
        change = "sed 's|{}|{}|' /test/fovead.toml > /test/other.toml; "
        other = start.format("/test/other.toml")
        status, said = board.run(change.format("width", "widht") + other)
        same((status, said), (78, ["fovead: /test/other.toml:4:1: unknown key widht in camera; did you mean width?"]))
        status, said = board.run(change.format("video0", "video7") + "sed -i '/^width/d' /test/other.toml; " + other)
        same(status, 69)
        holds(said[0], "/dev/video7: open: No such file or directory; it is not there: plug it in, or correct its name")
        # F16: line 3 is the board's power button.
        status, said = board.run(change.format('ready = "1"', 'ready = "3"') + other)
        same(status, 69)
        holds(said[0], "line 3 (ready)")
        holds(said[0], "GPIO Key Poweroff")
        # F30: a second one on the same devices, and on the camera and the serial port alone.
        board.start()
        status, said = board.run(start.format("/test/fovead.toml"))
        same(status, 69)
        holds(said[0], "fovea:ready")
        no_lines = "sed '/^.lines/,/^alarm/d' /test/fovead.toml > /test/other.toml; "
        status, said = board.run(no_lines + other)
        same(status, 69)
        holds(said[0], "another program is streaming from this camera: end it first")
        same(board.stop()[0], 0)


@case
def settings_are_read_anew_between_two_frames():
    with rig(VIVID + BY_COMMAND + LINES + SERIAL, cameras=1, loop=True, serial=["socket"],
             modules=["gpio-keys"]) as board:
        board.show("good")
        board.start()
        board.run("cp /test/jobs/disc.toml /test/jobs/second.toml; kill -HUP $daemon")
        board.event("reload")
        board.board.serial[0].sendall(b"JOBS?\r\n")
        same(heard(board.board, 1), ["OK 1 disc, 2 second"])
        board.run("cp /test/fovead.toml /test/kept.toml; echo '[nothing]' >> /test/fovead.toml; kill -HUP $daemon")
        holds(board.event("reload_failed")["reason"], "unknown table nothing")
        board.board.serial[0].sendall(b"JOB 2\r\nTRG\r\n")
        result = board.event("result")
        same((result["job"], result["verdict"]), ("second", "OK"))
        board.run("sed 's/^ok = .*/ok = \"3\"/' /test/kept.toml > /test/fovead.toml; kill -HUP $daemon")
        holds(board.event("reload_failed")["reason"], "GPIO Key Poweroff")
        board.board.serial[0].sendall(b"TRG\r\n")
        same(board.event("result")["verdict"], "OK")
        same(board.stop()[0], 0)


@case
def signals_at_any_moment_do_no_harm():
    with rig(VIVID + BY_COMMAND + LINES, cameras=1, loop=True) as board:
        board.show("good")
        board.start()
        # F22: 1000 signals without a pause; SIGHUPs that come together are one.
        board.run("cp /test/fovead.toml /test/kept.toml")
        board.run("i=0; while [ $i -lt 500 ]; do kill -HUP $daemon; kill -PIPE $daemon; i=$((i+1)); done")
        time.sleep(1)
        same(board.run("kill -0 $daemon")[0], 0)
        status, seconds = board.stop()
        same(status, 0)
        at_most(seconds, 1.5, "SIGTERM ends it within a second")


@case
def a_serial_line_that_is_stuck_or_gone_moves_no_verdict():
    settings = VIVID + BY_LINE + LINES + SERIAL.replace("/dev/ttyS0", "/dev/ttyUSB0")
    with rig(settings, cameras=1, loop=True, usb_serial=["socket"]) as board:
        board.show("good")
        board.start()
        same(board.pins.wait_for(READY, 1), True)
        times = {}
        for state in ("there", "gone", "back"):
            if state == "gone":
                board.board.unplug_usb_serial(0)
                board.event("serial_lost")
            if state == "back":
                board.board.plug_usb_serial(0)
                board.event("serial_back")
            times[state] = []
            for _ in range(20):
                result = board.trigger()
                same(result["verdict"], "OK")
                times[state].append(result["us"]["answer"])
                board.pins.wait_for(READY, 1)
        medians = {state: int(statistics.median(each)) for state, each in times.items()}
        for state, median in medians.items():
            figures[f"F13: from the edge to the answer with the serial port {state}, median of 20"] = f"{median} us"
        at_most(medians["gone"], medians["there"] * 3 // 2, "I7: the answer does not wait for the port")
        same(board.stop()[0], 0)


@case
def nothing_is_allocated_after_the_start():
    with rig(VIVID + BY_COMMAND + LINES + SERIAL, cameras=1, loop=True, serial=["socket"]) as board:
        board.show("good")
        board.tell("fovead_counted --config /etc/fovea/fovead.toml < /dev/null 2> /tmp/complaints & daemon=$!")
        board.event("start")
        time.sleep(1)
        board.run("kill -USR1 $daemon; sleep 0.2")
        for _ in range(30):
            board.board.serial[0].sendall(b"TRG\r\nJOB 1\r\nSTAT?\r\nLAST?\r\nNONSENSE\r\n")
            board.event("result")
        board.run("kill -USR1 $daemon; sleep 0.2")
        _, said = board.run("cat /tmp/complaints")
        same(len(said), 2)
        same(said[0], said[1])
        figures["calls of the heap before READY"] = said[0].split()[-1]
        figures["calls of the heap in 30 triggers after READY"] = str(int(said[1].split()[-1]) - int(said[0].split()[-1]))
        same(board.stop()[0], 0)


@case
def time_may_step_by_a_year():
    with rig(VIVID + BY_LINE + LINES, cameras=1, loop=True) as board:
        board.show("good")
        board.start()
        same(board.pins.wait_for(READY, 1), True)
        for date in ("2035-01-01", "1999-12-31", "2026-06-01"):
            board.run(f"date -s {date}")
            result = board.trigger()
            same(result["verdict"], "OK")
            at_most(result["us"]["answer"], 1000000, "the answer in microseconds")
            board.pins.wait_for(READY, 1)
        same([event for event in board.events if event["ev"] != "result"], [])
        same(board.stop()[0], 0)


@case
def who_reads_the_output_may_go():
    with rig(VIVID + BY_LINE + LINES, cameras=1) as board:
        board.tell("fovead --config /etc/fovea/fovead.toml < /dev/null | head -n 1 > /dev/null &")
        same(board.pins.wait_for(READY, 1), True)
        # Results that nobody takes any more.
        for _ in range(3):
            board.pins.drive(TRIGGER, 1)
            same(board.pins.wait_for(BUSY, 0), True)
            board.pins.drive(TRIGGER, 0)
            board.pins.wait_for(READY, 1, seconds=2)
        used = "set -- $(cat /proc/$(pidof fovead)/stat); echo $((${14} + ${15}))"
        before = int(board.run(used)[1][0])
        board.run("sleep 3")
        at_most(int(board.run(used)[1][0]) - before, 150, "hundredths of a second of the processor in 3 s")


@case
def a_limit_of_memory_is_told():
    with rig(VIVID + BY_COMMAND + LINES, cameras=1) as board:
        start = "fovead --config /test/fovead.toml 2>&1 > /dev/null < /dev/null"
        # From too little for anything to enough.
        endings = {(71, "out of memory"), (69, "Cannot allocate memory")}
        refused = []
        for kib in range(3000, 40000, 500):
            status, said = board.run(f"(ulimit -v {kib}; timeout 2 {start})")
            if status == 0:
                break
            # With the least it does not even begin, as the shell or the system say.
            if status not in (126, 127, 139) and (status, said) != (1, []):
                refused.append((status, " ".join(said)))
        same(status, 0)
        same([each for each in refused if not any(each[0] == code and words in each[1] for code, words in endings)], [])
        at_most(2, len(refused), f"limits that are refused: {refused}")


if __name__ == "__main__":
    words = sys.argv[2:]
    path = words[words.index("--figures") + 1] if "--figures" in words else None
    if path is not None:
        at = words.index("--figures")
        words[at:at + 2] = []
    status = run_cases("fovead on the emulated board", words)
    for name in sorted(figures):
        print(f"  {name}: {figures[name]}")
    if path is not None:
        with open(path, "w") as file:
            file.writelines(f"{name} = {figures[name]}\n" for name in sorted(figures))
    sys.exit(status)
