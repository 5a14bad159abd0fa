#!/usr/bin/env python3
"""Prints docs/faults.md: the faults that are provoked, what must become of each, and where it is proved.

usage: faults_page.py [FIGURES...]             FIGURES as ports_test.py, power_cut.py, fovead_test.py and service_test.py write them
       faults_page.py --check PAGE [FIGURES...]  PAGE must be that, but for the numbers; every proof must be there
"""
import re
import sys
from pathlib import Path

TESTS = Path(__file__).resolve().parents[1]

# Fault, how it is provoked, what must become of it, its proofs: tests by their names, cases of scripts by their functions.
ROWS = [
    ("F1", "the camera is unplugged in a stream", "vivid's Disconnect, 100 times; a USB camera whose program ends",
     "lost within a frame, no frame lent, all files and mappings given back; triggers are answered ERROR, alarm",
     "V4l2Camera.AnUnpluggedCameraIsLostAndComesBack Daemon.AnswersErrorAtOnceWithoutACamera "
     "DaemonWaits.WithoutSpinningForWhateverIsAway faults_of_a_webcam the_camera_port_on_usb_cameras "
     "a_usb_camera_that_was_unplugged_is_found_again every_fault_of_a_webcam_through_the_daemon"),
    ("F2", "it is plugged in again, perhaps as another node", "the same; another port of the hub",
     "found by its identity as soon as its node is there, controls set again; of another size it is refused",
     "CameraKeeper.HurriesWhereSomethingWasPluggedIn CameraKeeper.LooksForALostCameraMoreAndMoreSeldom "
     "CameraKeeper.StaysAwayFromACameraOfAnotherSize DeviceWatch.TellsThatANodeCameAndThatItsRightsChanged "
     "the_camera_port_on_usb_cameras a_usb_camera_that_was_unplugged_is_found_again "
     "every_fault_of_a_webcam_through_the_daemon"),
    ("F3", "a fatal error of the stream", "vivid's Inject Fatal Streaming Error, 20 times",
     "started again once before it is opened again; no busy loop",
     "V4l2Camera.ABrokenStreamStartsAgain CameraKeeper.StartsABrokenStreamAgainWithoutOpening faults_of_a_webcam "
     "every_fault_of_a_webcam_through_the_daemon"),
    ("F4", "a frame is marked as damaged, or cut short", "vivid's error flag, 20 times; a USB camera's error bit",
     "counted, never lent; the trigger takes the next frame, or its answer is ERROR",
     "V4l2Camera.NeverLendsAFrameThatIsMarkedOrShort Daemon.TakesTheNextFrameForOneThatIsDamaged faults_of_a_webcam "
     "the_camera_port_on_usb_cameras every_fault_of_a_webcam_through_the_daemon mjpeg_is_judged_and_damaged_frames_never"),
    ("F5", "the driver drops frames", "vivid drops 40 %", "counted by the holes in their numbers",
     "V4l2Camera.CountsFramesThatTheDriverLost faults_of_a_webcam every_fault_of_a_webcam_through_the_daemon"),
    ("F6", "the camera streams and is silent", "vivid drops 100 %",
     "told once; started again, then opened again, then every 2 s",
     "V4l2Camera.SaysThatNothingCame CameraKeeper.BreaksSilenceByAStartThenByOpening "
     "DaemonWaits.WithoutSpinningForWhateverIsAway faults_of_a_webcam every_fault_of_a_webcam_through_the_daemon"),
    ("F7", "the numbers of frames run over", "vivid begins at 2^32 - 128", "no false gap",
     "SequenceGaps.RunsOverFromTheLastNumberToTheFirst faults_of_a_webcam every_fault_of_a_webcam_through_the_daemon"),
    ("F8", "time stamps of the future, of the past, that run over", "vivid's own are ahead; Wrap Timestamp",
     "no age below 0, no overflow, and no trigger paired with a frame from before it",
     "FrameStamps.SurvivesAStampThatWrapsAround V4l2Camera.StampsOfTheFutureAgeFromZero faults_of_a_webcam "
     "every_fault_of_a_webcam_through_the_daemon"),
    ("F9", "calls of the driver fail", "vivid's injections; every call of a scenario fails, once and for ever",
     "a status and an errno for each, and nothing left behind",
     "V4l2Camera.GivesAllBackWhicheverCallFails V4l2Camera.OneRefusalOfACallIsNotTheEnd the_camera_port_on_a_webcam "
     "every_fault_of_a_webcam_through_the_daemon"),
    ("F10", "damaged MJPEG", "every truncation of small pictures, flipped bits, no codes, wrong sizes; fuzzing",
     "an error or a whole picture; a part of one is never judged",
     "GrayFrameOfMjpeg.IsAnErrorForEveryTruncation GrayFrameOfMjpeg.WithFlippedBitsIsAnErrorOrAnImage "
     "GrayFrameOfMjpeg.ByLibjpegIsTheSameWithoutItsCodes mjpeg_is_judged_and_damaged_frames_never"),
    ("F11", "the driver gives another size or stride, or fills a part of the frame", "simulated; vivid after a larger size",
     "rows are read by their stride; what was not asked for is refused",
     "V4l2Camera.ReadsRowsWithPadding V4l2Camera.RefusesAFormatThatIsNotTheOneAskedFor "
     "V4l2Camera.LetsTheDriverFillTheWholeFrame four_processors_judge_a_multi_planar_camera_whose_size_changes"),
    ("F12", "a multi-planar driver", "vivid with multiplanar=2", "the same bytes",
     "V4l2Camera.ReadsMultiPlanarDrivers pictures_through_a_multi_planar_driver "
     "four_processors_judge_a_multi_planar_camera_whose_size_changes"),
    ("F13", "the serial port is pulled", "an FTDI adapter of the emulated board, a pty",
     "opened again by its identity; records whole, the newest kept; no verdict waits",
     "SerialLink.OpensALostPortEverySecondAndTellsOnce DaemonWaits.WithoutSpinningForWhateverIsAway "
     "DaemonLatency.IsMovedByNoOutput a_usb_serial_adapter_that_is_pulled "
     "a_serial_line_that_is_stuck_or_gone_moves_no_verdict"),
    ("F14", "nobody reads the serial port", "a 16550 whose other end stops", "nothing waits; records whole or not at all",
     "RecordsAtRandom.ArriveWholeAndInOrderOrAreCounted Daemon.ASerialLineThatIsStuckOrGoneMovesNoVerdict "
     "DaemonWaits.WithoutSpinningForWhateverIsAway DaemonLatency.IsMovedByNoOutput a_serial_port_whose_reader_stops "
     "nothing_that_is_wrong_with_its_outputs_moves_a_verdict"),
    ("F15", "hostile bytes on the serial port", "random bytes, endless lines, floods; fuzzing",
     "errors are answered, nothing changes, triggers go on",
     "Command.ReadsAnyBytes Daemon.AFloodOfCommandsDoesNotKeepItFromItsTriggers LinesAtRandom.NeverHoldAControlByte "
     "DaemonLatency.IsMovedByNoOutput nothing_that_is_wrong_with_its_outputs_moves_a_verdict"),
    ("F16", "a GPIO line is taken", "the board's power button", "its holder is named, status 69",
     "what_is_wrong_at_the_start_is_said_in_a_line lines_of_a_gpio_chip"),
    ("F17", "triggers bounce, come in bursts, or while busy", "edges from outside the board; simulated",
     "each has one answer; lost ones are counted by the kernel's numbers",
     "Daemon.CountsTriggersThatCameWhileBusy Daemon.EveryTriggerHasOneAnswerWhateverComes lines_of_a_gpio_chip "
     "triggers_that_come_while_it_stands_still_are_answered"),
    ("F18", "the disk is full, or can only be read", "every call of storing fails with ENOSPC, EROFS, EDQUOT",
     "told once and when it ends; inspection goes on",
     "RingKeeper.TellsOfAFullDiskOnceAndOfItsEndOnce RingFolder.HoldsWholePairsAfterTheFailureOfEveryCall "
     "Daemon.TellsThatPicturesOfFailuresCannotBeKept DaemonLatency.IsMovedByNoOutput "
     "nothing_that_is_wrong_with_its_outputs_moves_a_verdict"),
    ("F19", "the disk hangs", "a store that blocks", "pictures are dropped and counted; no verdict waits",
     "FailureRing.NeverWaitsForADiskThatHangs BackgroundWriter.EndsWithinItsPatience DaemonLatency.IsMovedByNoOutput "
     "nothing_that_is_wrong_with_its_outputs_moves_a_verdict"),
    ("F20", "power is cut while something is saved", "the emulated board is killed at random moments, one that saves alone and one with the daemon; a model of a disk",
     "never a bad file, never older than what was acknowledged",
     "GenerationsAndPowerCuts.NeverLoseWhatWasAcknowledged GenerationsAndPowerCuts.AreSeenByThisTestOnADiskThatLies "
     "power_is_cut_while_failures_are_kept"),
    ("F21", "wrong settings or jobs", "files with faults; fuzzing",
     "status 78 with file, line and column; read anew, the old ones stay",
     "Settings.SayWhatIsWrongAndWhere what_is_wrong_at_the_start_is_said_in_a_line "
     "settings_are_read_anew_between_two_frames"),
    ("F22", "signals at any moment", "1000 signals without a pause", "ends within a second, lines inactive; reloads whole",
     "signals_at_any_moment_do_no_harm verdicts_come_out_on_lines_serial_and_as_json"),
    ("F23", "the clock steps by years", "date -s on the board", "nothing fires, no time jumps",
     "time_may_step_by_a_year"),
    ("F27", "a limit of memory", "ulimit -v on the board", "status 71 or 69 with a sentence before READY; after it nothing is allocated",
     "a_limit_of_memory_is_told nothing_is_allocated_after_the_start"),
    ("F28", "a stage hangs", "under systemd: a call for a frame, a line or the serial port never comes back; SIGSTOP",
     "no answer is shown, the watchdog ends it and all lines are inactive; begun again 2 s after WatchdogSec at the latest, it judges",
     "a_daemon_that_hangs_is_started_again_with_its_lines_safe"),
    ("F29", "no file left to open", "ulimit -n on the board, from too few to enough",
     "status 71 or 69 with a sentence before READY; with the least that is taken a camera that is pulled comes back",
     "no_file_left_to_open"),
    ("F30", "two daemons, one camera, port or line", "started twice", "the second says who holds it, status 69",
     "what_is_wrong_at_the_start_is_said_in_a_line"),
    ("F31", "a dark, saturated, covered or defocused picture", "rendered scenes, blurred and dimmed",
     "ERROR and an event of its own, never NG",
     "ImageQuality.TellsADeadLampFromABadPart ImageQuality.FallsAsTheBlurGrows "
     "Daemon.TellsABadPictureApartFromABadPart nothing_that_is_wrong_with_its_outputs_moves_a_verdict"),
]
MISSING = [
    ("F24 to F26", "network servers", "the daemon has none"),
]

INVARIANTS = [
    ("I1", "every trigger has one answer, and the counts add up to them"),
    ("I2", "no verdict of a frame that is marked, short, undecodable or older than its trigger, nor while the camera is lost"),
    ("I3", "OK and NG never together; VALID only with one of them, which does not change meanwhile"),
    ("I4", "as many files and mappings as before, once the fault is over, and as much memory"),
    ("I5", "while it waits for the end of a fault, and after it, at most 20 system calls a second; where frames come, no turns "
           "but for these"),
    ("I6", "a fault is told once, with a reason, and its end once"),
    ("I7", "a fault of an output moves 99 of 100 answers by at most 5 %, where every system call takes time"),
]
# What fovead_test.py has checked in each row, and service_test.py in those of IN_SERVICE; they fail where this is not so.
ON_BOARD = {name: "I1 I2 I3 I4 I5 I6" for name, *_ in ROWS}
IN_SERVICE = {"F28"}

# What tests of these suites check, through DaemonWorld.
ON_HOST = {"Daemon": "I1 I2 I3 I4 I6", "DaemonWaits": "I1 I2 I3 I4 I5 I6", "DaemonLatency": "I1 I3 I4 I6 I7"}


def on_host(proofs):
    suites = {proof.split(".")[0] for proof in proofs.split() if "." in proof}
    return sorted({name for suite in suites for name in ON_HOST.get(suite, "").split()})


def page(figures):
    lines = ["# Faults", "",
             "Made by `tests/board/faults_page.py`. What goes wrong in the field, how it is provoked here, what must become of",
             "it, and the tests that prove it. Cases in small letters run on the emulated board, with Debian's kernel and its",
             "drivers (`tests/run board`); the others on the host, with sanitizers.", "",
             "| | fault | provoked by | must | proved by |", "|---|---|---|---|---|"]
    for name, fault, how, must, proofs in ROWS:
        lines.append(f"| {name} | {fault} | {how} | {must} | {'<br>'.join(f'`{proof}`' for proof in proofs.split())} |")
    lines += ["", "## Invariants", "",
              "What holds whatever is wrong. On the board `tests/board/invariants.py` checks them of all that a run gave: what",
              "the daemon said, its pins from outside, its serial line, and what the kernel counts of it; on the host",
              "`tests/support/daemon_invariants.hpp`, in every test of the daemon; of I4 it sees the camera's files.", "",
              "I7 is about outputs, and so are its rows: F13 to F15, F18 and F19, on the host, where time is simulated and exact;",
              "the board gives the figures below. In F28 the trigger whose answer hangs has none: the lines that the watchdog makes",
              "inactive are what is seen of it, and systemd tells of the fault, once. F20's daemon is cut off while it keeps a",
              "failure, and begins again on the same disk.", "",
              "| | |", "|---|---|"]
    lines += [f"| {name} | {what} |" for name, what in INVARIANTS]
    lines += ["", "| | fault | checked on the board | checked on the host |", "|---|---|---|---|"]
    for name, fault, _, _, proofs in ROWS:
        lines.append(f"| {name} | {fault} | {ON_BOARD.get(name, '')} | {' '.join(on_host(proofs))} |")
    lines += ["", "## Not proved", "", "| | fault | |", "|---|---|---|"]
    lines += [f"| {name} | {fault} | {why} |" for name, fault, why in MISSING]
    lines += ["", "## Figures", "",
              "Of one run on the emulated board. Its processor is software, beside which others run: real boards are faster.", "",
              "| | |", "|---|---|"]
    lines += [f"| {name} | {value} |" for name, value in sorted(figures.items())]
    return "\n".join(lines) + "\n"


def missing_proofs():
    sources = "\n".join(path.read_text() for path in TESTS.rglob("*_test.cpp"))
    scripts = "\n".join(path.read_text() for path in (TESTS / "board").glob("*.py") if path.name != Path(__file__).name)
    for row in ROWS:
        for proof in row[4].split():
            there = f"TEST({proof.replace('.', ', ')})" in sources if "." in proof else f"def {proof}(" in scripts
            if not there:
                yield f"{row[0]}: there is no {proof}"


def main():
    words = sys.argv[1:]
    checked = words[1] if words[:1] == ["--check"] else None
    figures = {}
    for path in words[2 if checked else 0:]:
        for line in Path(path).read_text().splitlines():
            name, value = line.split(" = ", 1)
            figures[name] = value
    text = page(figures)
    complaints = list(missing_proofs())
    if checked is None:
        print(text, end="")
    else:
        def without_numbers(page_text):
            return re.sub(r"\d+", "#", page_text.split("## Figures")[1 if figures else 0])
        def rows(page_text):
            return page_text.split("## Figures")[0]
        seen = Path(checked).read_text()
        if rows(seen) != rows(text):
            complaints.append(f"{checked} is not what faults_page.py prints")
        if figures and without_numbers(seen) != without_numbers(text):
            complaints.append(f"{checked} has other figures than were measured: look at both, then print it anew")
    for complaint in complaints:
        print(f"faults_page: {complaint}", file=sys.stderr)
    if not complaints and checked:
        print(f"{checked}: {len(ROWS)} faults, {len(figures)} figures")
    sys.exit(1 if complaints else 0)


if __name__ == "__main__":
    main()
