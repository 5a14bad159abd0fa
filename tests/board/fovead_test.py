#!/usr/bin/env python3
"""The daemon on the emulated board, seen from outside: fovead_test.py PROGRAMS [--figures FILE] [WORD...]

PROGRAMS is the folder of the programs that were compiled for the board. Cameras, serial lines and pins are those of the
kernel; pictures go in through them, and what comes out is read on the other end of the lines.
"""
import json
import random
import statistics
import subprocess
import sys
import tempfile
import time

from cases import case, holds, run_cases, same
from daemon_rig import (ALARM, BUSY, BY_COMMAND, BY_LINE, CODE_JOB, CODES, LINES, NG, OK, PATTERN_RECIPE, READY, SERIAL, TRIGGER,
                        USB, VALID, VIVID, WIDTH, HEIGHT, DaemonRig)
from faults_page import IN_SERVICE, ON_BOARD
from watched import unlike_the_page

PROGRAMS = sys.argv[1]
LOOPED_FRAMES_PER_S = 60  # of vivid as an input for video signals
figures = {}


def rig(settings, *recipe, **options):
    return DaemonRig(PROGRAMS, settings, *recipe, **options)


def at_most(value, limit, what):
    if value > limit:
        raise AssertionError(f"{what}: {value}, more than {limit}")


def judged(result, verdict):
    same((result["verdict"], result["why"] if verdict == "OK" else None), (verdict, None))


def spread(name, times_us):
    """Median, 99 of 100 and the most, as figures."""
    times = sorted(times_us)
    figures[f"{name}, median of {len(times)}"] = f"{int(statistics.median(times))} us"
    figures[f"{name}, 99 of 100"] = f"{times[(len(times) - 1) * 99 // 100]} us"
    figures[f"{name}, the most"] = f"{times[-1]} us"


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
        same(board.trigger()["feature"], "holes")
        time.sleep(0.2)
        # The answer before is gone first; the line of the new one comes before valid, and busy ends last.
        same(board.pins.changes(), [(READY, 0), (VALID, 0), (OK, 0), (BUSY, 1), (NG, 1), (VALID, 1), (BUSY, 0), (READY, 1)])
        same([line.split(";")[:2] for line in board.heard(3)], [["1", "OK"], ["2", "OK"], ["3", "NG"]])
        times = board.latencies("there", 30)
        figures["from the trigger's edge to the answer, median of 30"] = f"{int(statistics.median(times))} us"
        figures["from the trigger's edge to the answer, the most of 30"] = f"{times[-1]} us"
        same(board.statistics().split(" us ")[0], "#9 OK triggers 33 ok 2 ng 31 error 0 missed 0")
        board.pins.changes()
        board.provoke("F22")
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
        board.provoke("F1", "camera_lost", 3)
        board.provoke("F2")
        for port in (1, 0, 3):
            board.run("kill $camera; wait $camera")
            board.event("camera_lost")
            same(board.pins.wait_for(ALARM, 1), True)
            if port == 1:
                # From the plug pulled on, with all its looks for the camera.
                calls = board.count_calls("F1", "without a camera", 4)
                figures["F1: system calls a second without a camera"] = f"{calls:.1f}"
            same(board.trigger()["why"], "no_camera")
            board.tell(camera.format(port))
            back.append(board.event("camera_back")["after_us"])
            same(board.pins.wait_for(READY, 1), True)
            judged(board.trigger(), "OK")
            same(board.pins.wait_for(READY, 1), True)
        figures["F2: fovead, from a USB camera's loss to its next frame, the least of 3"] = f"{min(back)} us"
        same(board.stop()[0], 0)
        same(board.run("ls /proc/$daemon 2>/dev/null | wc -l")[1], ["0"])


@case
def what_is_wrong_at_the_start_is_said_in_a_line():
    with rig(VIVID + BY_COMMAND + LINES + SERIAL, cameras=1, loop=True, serial=["socket"],
             modules=["gpio-keys"]) as board:
        board.show("good")
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
        board.provoke("F16")
        status, said = board.run(change.format('ready = "1"', 'ready = "3"') + other)
        same(status, 69)
        holds(said[0], "line 3 (ready)")
        holds(said[0], "GPIO Key Poweroff")
        # F30: a second one on the same devices, and on the camera and the serial port alone.
        board.provoke("F30")
        board.start()
        status, said = board.run(start.format("/test/fovead.toml"))
        same(status, 69)
        holds(said[0], "fovea:ready")
        no_lines = "sed '/^.lines/,/^alarm/d' /test/fovead.toml > /test/other.toml; "
        status, said = board.run(no_lines + other)
        same(status, 69)
        holds(said[0], "another program is streaming from this camera: end it first")
        for _ in range(2):
            board.board.serial[0].sendall(b"TRG\r\n")
            judged(board.event("result"), "OK")
        board.statistics()
        same(board.stop()[0], 0)


@case
def settings_are_read_anew_between_two_frames():
    with rig(VIVID + BY_COMMAND + LINES + SERIAL, cameras=1, loop=True, serial=["socket"],
             modules=["gpio-keys"]) as board:
        board.show("good")
        board.start()
        board.provoke("F21")
        board.run("cp /test/jobs/disc.toml /test/jobs/second.toml; kill -HUP $daemon")
        board.event("reload")
        board.board.serial[0].sendall(b"JOBS?\r\n")
        same(board.heard(1), ["OK 1 disc, 2 second"])
        board.run("cp /test/fovead.toml /test/kept.toml; echo '[nothing]' >> /test/fovead.toml; kill -HUP $daemon")
        holds(board.event("reload_failed")["reason"], "unknown table nothing")
        board.board.serial[0].sendall(b"JOB 2\r\nTRG\r\n")
        result = board.event("result")
        same((result["job"], result["verdict"]), ("second", "OK"))
        board.run("sed 's/^ok = .*/ok = \"3\"/' /test/kept.toml > /test/fovead.toml; kill -HUP $daemon")
        holds(board.event("reload_failed")["reason"], "GPIO Key Poweroff")
        board.board.serial[0].sendall(b"TRG\r\n")
        same(board.event("result")["verdict"], "OK")
        board.statistics()
        same(board.stop()[0], 0)


@case
def signals_at_any_moment_do_no_harm():
    with rig(VIVID + BY_LINE + LINES, cameras=1, loop=True) as board:
        board.show("good")
        board.start()
        # What reading settings anew takes of the heap is taken with the first time.
        board.run("kill -HUP $daemon")
        board.event("reload")
        judged(board.trigger(), "OK")
        board.provoke("F22")
        # F22: 1000 signals without a pause; SIGHUPs that come together are one.
        board.run("cp /test/fovead.toml /test/kept.toml")
        board.run("i=0; while [ $i -lt 500 ]; do kill -HUP $daemon; kill -PIPE $daemon; i=$((i+1)); done")
        time.sleep(1)
        same(board.run("kill -0 $daemon")[0], 0)
        board.pins.wait_for(READY, 1)
        judged(board.trigger(), "OK")
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
        for state in ("there", "gone", "back"):
            if state == "gone":
                board.provoke("F13", "serial_lost")
                board.board.unplug_usb_serial(0)
                board.event("serial_lost")
                calls = board.count_calls("F13", "without the serial port", frames=LOOPED_FRAMES_PER_S)
                figures["F13: system calls a second without the serial port, with frames"] = f"{calls:.1f}"
            if state == "back":
                board.board.plug_usb_serial(0)
                board.event("serial_back")
            spread(f"F13: from the edge to the answer with the serial port {state}", board.latencies(state, 20))
        board.heard(61)
        board.statistics()
        same(board.stop()[0], 0)


@case
def nothing_is_allocated_after_the_start():
    with rig(VIVID + BY_COMMAND + LINES + SERIAL, cameras=1, loop=True, serial=["socket"]) as board:
        board.show("good")
        board.tell("fovead_counted --config /etc/fovea/fovead.toml < /dev/null 2> /tmp/complaints & daemon=$!")
        board.event("start")
        time.sleep(1)
        board.run("kill -USR1 $daemon; sleep 0.2")
        board.provoke("F27")
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
def codes_come_out_on_the_serial_line():
    settings = VIVID + BY_LINE + LINES + SERIAL.replace("{f.d1}", "{code}")
    with rig(settings, CODE_JOB, cameras=1, loop=True, serial=["socket"]) as board:
        board.show("code")
        board.start("fovead_counted")
        same(board.pins.wait_for(READY, 1), True)
        board.run("kill -USR1 $daemon; sleep 0.2")
        for name, verdict, why, text in (("code", "OK", None, CODES["code"]), ("other_code", "NG", "wrong_code", CODES["other_code"]),
                                         ("good", "NG", "no_code", None), ("code", "OK", None, CODES["code"])):
            board.show(name)
            result = board.trigger()
            same((result["verdict"], result["why"], [code["text"] for code in result["codes"]]),
                 (verdict, why, [text] if text else []))
            same(board.pins.wait_for(READY, 1), True)
        code = result["codes"][0]
        same((code["symbology"], code["aim"], code["grade"] in ("A", "B", "C"), code["why"]), ("EAN-13", "]E0", True, None))
        # The bars that were drawn begin and end there.
        same([abs(x - edge) < 1 for (x, _), edge in zip(code["corners_px"], (129.5, 509.5, 509.5, 129.5))], [True] * 4)
        same(board.heard(4), [f"1;OK;{CODES['code']}", f"2;NG;{CODES['other_code']}", "3;NG;?", f"4;OK;{CODES['code']}"])
        board.run("kill -USR1 $daemon; sleep 0.2")
        _, said = board.run("cat /tmp/complaints")
        figures["calls of the heap in 4 triggers of codes"] = str(int(said[1].split()[-1]) - int(said[0].split()[-1]))
        same(said[0], said[1])
        figures["from the trigger's edge to the verdict of a code"] = f"{result['us']['answer']} us"
        board.statistics()
        same(board.stop()[0], 0)


@case
def time_may_step_by_a_year():
    with rig(VIVID + BY_LINE + LINES, cameras=1, loop=True) as board:
        board.show("good")
        board.start()
        same(board.pins.wait_for(READY, 1), True)
        board.trigger()
        same(board.pins.wait_for(READY, 1), True)
        board.provoke("F23")
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
        board.run("daemon=$(pidof fovead)")
        board.count_calls(None, "without a reader of the output", 3, frames=LOOPED_FRAMES_PER_S)


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


def press(board, button):
    same(board.run(f"camera_on_board press '{button}' > /dev/null")[0], 0)


def set_control(board, name, value):
    same(board.run(f"camera_on_board set '{name}' {value} > /dev/null")[0], 0)


@case
def every_fault_of_a_webcam_through_the_daemon():
    with rig(VIVID + "rate_per_s = 60\n" + BY_LINE + LINES, PATTERN_RECIPE, cameras=1) as board:
        # The words over an even green are parts.
        set_control(board, "Test Pattern", 8)
        same(board.start()["camera"], "/dev/video0")
        same(board.pins.wait_for(READY, 1), True)

        def peace(triggers=1):
            for _ in range(triggers):
                result = board.trigger()
                same(result["verdict"] in ("OK", "NG") or result, True)
                same(board.pins.wait_for(READY, 1), True)
            return result
        peace()
        board.provoke("F1", "camera_lost", 20)
        board.provoke("F2")
        board.provoke("F3", "camera_broken", 20)
        for name, button, onset in (("F2: fovead, from a webcam's loss to its next frame", "Disconnect", "camera_lost"),
                                    ("F3: fovead, from a broken stream to its next frame", "Inject Fatal Streaming Error",
                                     "camera_broken")):
            back = []
            for _ in range(20):
                press(board, button)
                board.event(onset)
                back.append(board.event("camera_back")["after_us"])
            spread(name, back)
            peace()
        board.hold()
        # A start that is refused: the camera is opened again.
        board.provoke("F9", "camera_broken")
        press(board, "Inject VIDIOC_STREAMON Error")
        press(board, "Inject Fatal Streaming Error")
        board.event("camera_back")
        peace()
        board.provoke("F4")
        for _ in range(10):
            press(board, "Inject V4L2_BUF_FLAG_ERROR")
            peace()
        board.provoke("F5")
        set_control(board, "Percentage of Dropped Buffers", 40)
        peace(10)
        board.provoke("F6", "camera_silent")
        set_control(board, "Percentage of Dropped Buffers", 100)
        board.event("camera_silent")
        same(board.trigger()["why"], "no_camera")
        # It is opened every 3 s: as long as silence takes to be heard, and 2 s.
        calls = board.count_calls("F6", "with a camera that is silent", 6)
        figures["F6: system calls a second with a camera that is silent"] = f"{calls:.1f}"
        set_control(board, "Percentage of Dropped Buffers", 0)
        board.event("camera_back")
        same(board.pins.wait_for(READY, 1), True)
        # Another start of the stream, for these begin with one: 128 frames before the numbers run over, and with
        # stamps of the end of time.
        for row, control, value in (("F7", "Wrap Sequence Number", 1), ("F8", "Wrap Timestamp", 2)):
            board.provoke(row, "camera_broken")
            set_control(board, control, value)
            press(board, "Inject Fatal Streaming Error")
            board.event("camera_back")
            same(board.pins.wait_for(READY, 1), True)
            numbers = [peace()["frame"]["seq"] for _ in range(10)]
            while row == "F7" and numbers[-1] > numbers[0] and len(numbers) < 200:
                numbers.append(peace()["frame"]["seq"])
            same(numbers[-1] < numbers[0], row == "F7")
            set_control(board, control, 0)
        same(board.stop()[0], 0)


@case
def four_processors_judge_a_multi_planar_camera_whose_size_changes():
    with rig(VIVID.replace(f"width = {WIDTH}\nheight = {HEIGHT}", "width = 1280\nheight = 720") + BY_LINE + LINES,
             PATTERN_RECIPE, cameras=1, vivid="multiplanar=2", cpus=4) as board:
        set_control(board, "Test Pattern", 8)
        start = board.start()
        same((start["threads"], start["width"]), (4, 1280))
        same(board.pins.wait_for(READY, 1), True)
        board.provoke("F12")
        words = board.trigger()
        same((words["verdict"], words["parts"] > 0), ("OK", True))
        # vivid then fills as much of the smaller frame as it is told, and it was told the larger one.
        board.provoke("F11")
        board.run("sed -i 's/^width = .*/width = 640/; s/^height = .*/height = 360/' /test/fovead.toml; kill -HUP $daemon")
        same(board.event("start")["width"], 640)
        board.event("reload")
        same(board.pins.wait_for(READY, 1), True)
        smaller = board.trigger()
        same((smaller["verdict"], smaller["parts"] > 0), ("OK", True))
        # With one thread the same parts are found.
        board.run("echo '[processor]\nthreads = 1' >> /test/fovead.toml; kill -HUP $daemon")
        same(board.event("start")["threads"], 1)
        board.event("reload")
        same(board.pins.wait_for(READY, 1), True)
        same(board.trigger()["verdict"], "OK")
        same(board.stop()[0], 0)


@case
def nothing_that_is_wrong_with_its_outputs_moves_a_verdict():
    settings = (VIVID + BY_LINE + LINES + SERIAL + '[failures]\nfolder = "/run/disk/kept"\npictures = 3\n')
    with rig(settings, cameras=1, loop=True, serial=["socket"]) as board:
        line = board.board.serial[0]
        board.run("mkdir -p /run/disk; mount -t tmpfs -o size=4m disk /run/disk")
        board.show("bad")
        board.start("fovead_slow")
        same(board.pins.wait_for(READY, 1), True)
        board.latencies("all well", 5)
        spread("I7: from the edge to the answer with all outputs well", board.latencies("all well", 15))
        board.statistics()

        board.provoke("F15")
        noise = random.Random(15)
        line.sendall(bytes(noise.choice(range(128)) for _ in range(3000)) + b"x" * 3000 + b"\r\n" + b"JOB 9\r\n" * 100)
        board.latencies("hostile bytes", 10)
        board.heard(200, 3)

        # Nobody reads any more.
        board.provoke("F14")
        line.sendall(b"JOBS?\r\n" * 3000)
        spread("F14: from the edge to the answer while nobody reads the serial port", board.latencies("not read", 20))
        calls = board.count_calls("F14", "while nobody reads the serial port", frames=LOOPED_FRAMES_PER_S)
        figures["F14: system calls a second while nobody reads the serial port, with frames"] = f"{calls:.1f}"
        board.heard(10000, 3)
        board.statistics()

        board.provoke("F18", "failures_lost")
        # With pictures of its own it would make room.
        board.run("rm /run/disk/kept/*; dd if=/dev/zero of=/run/disk/full bs=4k 2> /dev/null")
        board.trigger()
        holds(board.event("failures_lost")["reason"], "No space left on device")
        board.pins.wait_for(READY, 1)
        spread("F18: from the edge to the answer with a full disk", board.latencies("full disk", 20))
        calls = board.count_calls("F18", "with a full disk", frames=LOOPED_FRAMES_PER_S)
        figures["F18: system calls a second with a full disk, with frames"] = f"{calls:.1f}"
        board.run("rm /run/disk/full")
        board.trigger()
        board.event("failures_kept")
        board.pins.wait_for(READY, 1)

        board.provoke("F19")
        board.run("touch /tmp/disk_hangs")
        spread("F19: from the edge to the answer with a disk that hangs", board.latencies("hanging disk", 20))
        board.run("rm /tmp/disk_hangs")

        board.provoke("F31", "image_quality")
        board.tell("echo >&3")
        while board.trigger()["verdict"] != "ERROR":
            board.pins.wait_for(READY, 1)
        same(board.pins.wait_for(READY, 1), True)
        board.show("good")
        board.latencies("light again", 6)
        board.statistics()
        same(board.stop()[0], 0)


@case
def triggers_that_come_while_it_stands_still_are_answered():
    with rig(VIVID + BY_LINE + LINES, cameras=1, loop=True) as board:
        board.show("good")
        board.start()
        same(board.pins.wait_for(READY, 1), True)
        judged(board.trigger(), "OK")
        same(board.pins.wait_for(READY, 1), True)
        # More edges than the kernel keeps of a line, which is 16: of those that are lost it keeps the count.
        board.provoke("F17")
        for edges in (3, 40):
            board.run("kill -STOP $daemon")
            for _ in range(edges):
                board.edge()
                board.run("true")  # by then the kernel has seen it: two at once are one to the chip
                board.pins.drive(TRIGGER, 0)
            board.run("kill -CONT $daemon")
            answers = [board.event("result", "trigger_missed")["ev"] for _ in range(edges)]
            same((answers.count("result") > 0, answers.count("trigger_missed") > 0), (True, True))
            judged(board.trigger(), "OK")
            same(board.pins.wait_for(READY, 1), True)
        same(board.stop()[0], 0)


def pairs_of_failures(board):
    """{number: endings} of what is kept; each picture is whole, and so is what is told of it."""
    kept = {}
    for line in board.run("cd /run/disk/kept 2> /dev/null && wc -c *; cd /")[1]:
        size, name = line.split()
        number, _, ending = name.partition(".")
        if ending in ("pgm", "json"):
            kept.setdefault(number, set()).add(ending)
            if ending == "pgm":
                same((name, int(size)), (name, len(f"P5\n{WIDTH} {HEIGHT}\n255\n") + WIDTH * HEIGHT))
            else:
                json.loads(board.run(f"sed 's/^/ /' /run/disk/kept/{name}; echo")[1][0])
    return kept


@case
def power_is_cut_while_failures_are_kept():
    dice = random.Random(20)
    with tempfile.TemporaryDirectory() as folder:
        disk = f"{folder}/disk.img"
        subprocess.run(["mkfs.ext4", "-q", "-F", disk, "32M"], check=True, stdout=subprocess.DEVNULL)
        settings = VIVID + BY_LINE + LINES + '[failures]\nfolder = "/run/disk/kept"\npictures = 8\n'
        with rig(settings, cameras=1, loop=True, disks=[disk], modules=["ext4"]) as board:
            for life in range(4):
                board.run("mkdir -p /run/disk; mount -t ext4 /dev/vda /run/disk")
                # A picture comes last of its pair: none is there without what is told of it.
                before = pairs_of_failures(board)
                same([number for number, endings in before.items() if endings == {"pgm"}], [])
                # Room is made before a new pair is written.
                same(len(before) in ((7, 8, 9) if life else (0,)) or before, True)
                board.show("bad")
                board.start()
                same(board.pins.wait_for(READY, 1), True)
                for _ in range(10):
                    judged(board.trigger(), "NG")
                    same(board.pins.wait_for(READY, 1), True)
                time.sleep(0.5)  # the last one is kept
                board.hold()
                if life < 3:
                    board.provoke("F20")
                    judged(board.trigger(), "NG")
                    time.sleep(dice.uniform(0, 0.1))
                    board.cut_power()
            after = pairs_of_failures(board)
            same((len(after), set(map(frozenset, after.values()))), (8, {frozenset({"pgm", "json"})}))
            same(board.stop()[0], 0)


@case
def no_file_left_to_open():
    settings = USB + BY_LINE + "timeout_ms = 5000\n" + LINES + SERIAL
    with rig(settings, cameras=0, serial=["socket"], modules=["vhci-hcd", "uvcvideo"]) as board:
        camera = "usb_camera --grey /test/good.gray --port {} > /dev/null & camera=$!"
        board.tell(camera.format(0))
        board.run("until [ -e /dev/video1 ]; do sleep 0.05; done")
        # From too few files for anything to enough. What is refused is told, and READY comes of none of it.
        limit, status, refused = 3, None, []
        while status != 0 and limit < 40:
            limit += 1
            status, said = board.run(f"(ulimit -n {limit}; exec timeout 1 fovead --config /test/fovead.toml) "
                                     "2>&1 > /tmp/said < /dev/null")
            if status != 0:
                refused.append(status)
                same((len(said), status in (69, 71), "Too many open files" in said[0]), (1, True, True))
                same(board.run("cat /tmp/said"), (0, []))
        same((set(refused), len(refused) > 10, status), ({69, 71}, True, 0))
        figures["F29: files that may be open, the least with a USB camera, seven lines and a serial port"] = str(limit)
        # With not one more than that, the camera comes back, and so do settings.
        board.provoke("F29")
        board.start(before=f"ulimit -n {limit};")
        same(board.pins.wait_for(READY, 1), True)
        judged(board.trigger(), "OK")
        for port in (1, 0):
            board.provoke("F1", "camera_lost")
            board.run("kill $camera; wait $camera")
            board.event("camera_lost")
            board.tell(camera.format(port))
            board.event("camera_back")
            same(board.pins.wait_for(READY, 1), True)
            judged(board.trigger(), "OK")
        board.heard(3)
        board.statistics()
        # A setting of the camera, so that all is opened anew.
        board.run("sed -i 's/^.camera./&\\nrate_per_s = 9/' /test/fovead.toml; kill -HUP $daemon")
        board.event("start")
        board.event("reload")
        same(board.pins.wait_for(READY, 1), True)
        judged(board.trigger(), "OK")
        same(board.stop()[0], 0)


@case
def mjpeg_is_judged_and_damaged_frames_never():
    # Every fourth frame shows the bad part, and all of these are marked or cut.
    damage = " ".join(f"{'--damage' if number % 8 == 3 else '--cut'} {number}" for number in range(3, 400, 4))
    settings = USB.replace("gray8", "mjpeg").replace("640", "640", 1) + "every_frame = true\n"
    with rig(settings + LINES, cameras=0, modules=["vhci-hcd", "uvcvideo nodrop=1"]) as board:
        files = " ".join(f"/test/{name}.jpg" for name in ("good", "good", "good", "bad"))
        board.tell(f"usb_camera --mjpeg {files} {damage} > /dev/null & camera=$!")
        board.run("until [ -e /dev/video1 ]; do sleep 0.05; done")
        start = board.start()
        same(start["format"], "mjpeg")
        board.provoke("F4")
        board.provoke("F10")
        for _ in range(60):
            judged(board.event("result"), "OK")
        board.provoke("F1", "camera_lost")
        board.run("kill $camera; wait $camera")
        board.event("camera_lost")
        board.tell("usb_camera --mjpeg /test/bad.jpg /test/good.jpg > /dev/null & camera=$!")
        board.event("camera_back")
        seen = [board.event("result")["verdict"] for _ in range(20)]
        same(set(seen), {"OK", "NG"})
        same(board.stop()[0], 0)


@case
def in_free_run_the_newest_frame_is_judged():
    with rig(VIVID + "rate_per_s = 40\n", PATTERN_RECIPE, cameras=1) as board:
        interval_us = board.start("fovead_slow")["interval_us"]
        results = [board.event("result") for _ in range(71)][10:]
        span_us = results[-1]["t_mono_us"] - results[0]["t_mono_us"]
        figures["free run: frames a second of the camera"] = f"{1000000 / interval_us:.1f}"
        figures["free run: frames a second judged, of 60"] = f"{60 * 1000000 / span_us:.1f}"
        ages = [result["frame"]["age_us"] for result in results]
        spread("free run: age of the frame judged", ages)
        # Each result takes 200 ms more now, as a job might.
        board.run("touch /tmp/slow_output")
        board.event("result")
        loaded = [board.event("result")["frame"]["age_us"] for _ in range(40)]
        spread("free run under a load of 200 ms: age of the frame judged", loaded)
        # A frame may wait for so long; what it was on its way before is the camera's, here software on a busy machine.
        at_most(max(loaded), max(ages) + interval_us * 3 // 2, "the age of the frame judged under a load")
        board.run("rm /tmp/slow_output")
        same(board.stop()[0], 0)


if __name__ == "__main__":
    words = sys.argv[2:]
    path = words[words.index("--figures") + 1] if "--figures" in words else None
    if path is not None:
        at = words.index("--figures")
        words[at:at + 2] = []
    status = run_cases("fovead on the emulated board", words)
    # The page must not tell of more than was checked, nor of less.
    status = status or unlike_the_page(ON_BOARD.keys() - IN_SERVICE, not words)
    for name in sorted(figures):
        print(f"  {name}: {figures[name]}")
    if path is not None:
        with open(path, "w") as file:
            file.writelines(f"{name} = {figures[name]}\n" for name in sorted(figures))
    sys.exit(status)
