#!/usr/bin/env python3
"""Proves the cameras of the emulated board: camera_rig_test.py USB_CAMERA TEST_FRAMES [WORD...]

USB_CAMERA is usb_camera.cpp compiled for the board, TEST_FRAMES test_frames.cpp compiled for the host. On the
board v4l2-ctl of Debian takes the frames, and here each byte is compared. Two boards run at a time.
"""
import contextlib
import re
import subprocess
import sys
import tempfile
from pathlib import Path

from cases import case, holds, run_cases, same
from emulated_board import EmulatedBoard

USB_CAMERA, TEST_FRAMES = (str(Path(word).resolve()) for word in sys.argv[1:3])
FORMATS = {"yuyv": "pixelformat=YUYV,width=640,height=360", "grey": "pixelformat=GREY,width=640,height=480",
           "mjpeg": "pixelformat=MJPG,width=640,height=480"}
COMMON = """
set -e
plugged_in() { until [ -e /dev/video$1 ]; do sleep 0.05; done; }
# take NODE FORMAT COUNT FILE [OPTION]
take() {
  v4l2-ctl -d /dev/video$1 --set-fmt-video=$2 --stream-mmap --stream-count=$3 --stream-to=$4 $5 2> /progress
}
"""


@contextlib.contextmanager
def booted(script, **options):
    """A board whose script has ended well."""
    with tempfile.TemporaryDirectory() as folder:
        fetch = {name: f"{folder}/{name}" for name in options.pop("fetch", [])}
        command = ["sh", "-c", COMMON + script]
        with EmulatedBoard(command, packages=["v4l-utils"], fetch=fetch, **options) as board:
            status = board.wait()
            if (status, board.trouble) != (0, ""):
                complaints = board.stderr.everything().decode()
                raise AssertionError(f"the script ended with {status}: {complaints}{board.trouble}")
            yield board.stdout.everything().decode(), Path(folder)


def with_usb_camera(script, **options):
    files = {"/test/usb_camera": USB_CAMERA, **options.pop("files", {})}
    return booted(script, modules=["vhci-hcd", "uvcvideo"], files=files, **options)


def numbers_in(mode, path):
    """The numbers of the frames in a file, all of which must be right."""
    done = subprocess.run([TEST_FRAMES, "check", mode, path], capture_output=True, text=True)
    if done.returncode != 0:
        raise AssertionError(f"{path.name}: {done.stdout}{done.stderr}")
    return [int(word) for word in done.stdout.split()]


def rising(numbers):
    return numbers == sorted(set(numbers))


def write_frames(mode, count, path):
    subprocess.run([TEST_FRAMES, "write", mode, str(count), path], check=True)


@case
def vivid_as_a_webcam_shows_what_its_controls_say():
    script = """
v4l2-ctl -d /dev/video0 --list-framesizes=GREY
for pattern in 5 6; do
  v4l2-ctl -d /dev/video0 --set-ctrl=test_pattern=$pattern,osd_text_mode=2
  take 0 pixelformat=GREY,width=320,height=180 5 /$pattern
done"""
    with booted(script, cameras=1, fetch=["5", "6"]) as (said, folder):
        holds(said, "Discrete 640x360")  # a webcam's list; an HDMI input has a range
        black, white = ((folder / name).read_bytes() for name in "56")
    same((len(black), len(white)), (5 * 320 * 180, 5 * 320 * 180))
    same((len(set(black)), len(set(white))), (1, 1))
    same((black[0] < 40, white[0] > 200), (True, True))


@case
def vivid_in_a_loop_gives_back_what_it_is_given():
    script = """
v4l2-ctl -d /dev/video0 --set-ctrl=loop_video=1,osd_text_mode=2
show() {
  v4l2-ctl -d /dev/video1 --set-fmt-video-out=$1 --stream-out-mmap --stream-from=$2 --stream-loop \\
    > /shown 2>&1 &
  until grep -q '>>>' /shown; do sleep 0.05; done
  take 0 $1 3 $3 --stream-skip=8
  kill $!; wait $! || true
  rm /shown
}
"""
    with tempfile.TemporaryDirectory() as given:
        for mode in ("grey", "yuyv"):
            write_frames(mode, 1, f"{given}/{mode}")
            script += f"show {FORMATS[mode]} /given/{mode} /{mode}\n"
        options = {"cameras": 1, "loop": True, "files": {"/given": given}, "fetch": ["grey", "yuyv"]}
        with booted(script, **options) as (_, folder):
            for mode in ("grey", "yuyv"):
                same(numbers_in(mode, folder / mode), [0, 0, 0])


@case
def every_byte_of_the_usb_camera_arrives_in_every_mode():
    script = "/test/usb_camera & plugged_in 0\n"
    script += "".join(f"take 0 {words} 10 /{mode}\n" for mode, words in FORMATS.items())
    with with_usb_camera(script, fetch=FORMATS) as (said, folder):
        numbers = [number for mode in FORMATS for number in numbers_in(mode, folder / mode)]
        same((len(numbers), rising(numbers)), (30, True))
        holds(said, "usb camera: mjpeg at 30 frames/s")


@case
def the_usb_camera_is_told_its_controls_and_rate():
    script = """
/test/usb_camera & plugged_in 0
v4l2-ctl -d /dev/video0 --set-ctrl=auto_exposure=1,exposure_time_absolute=123,gain=77,brightness=-5
v4l2-ctl -d /dev/video0 --get-ctrl=gain,brightness,exposure_time_absolute
v4l2-ctl -d /dev/video0 --set-fmt-video=$format
v4l2-ctl -d /dev/video0 --set-parm=15 --stream-mmap --stream-count=2 > /dev/null 2>&1"""
    with with_usb_camera(f"format={FORMATS['grey']}\n{script}") as (said, _):
        lines = said.splitlines()
    for line in ("exposure_mode = 1", "exposure_100us = 123", "gain = 77", "brightness = -5",
                 "grey at 15 frames/s"):
        same((line, lines.count(f"usb camera: {line}")), (line, 1))
    same([line for line in lines if ": " in line and "usb" not in line],
         ["gain: 77", "brightness: -5", "exposure_time_absolute: 123"])


@case
def damaged_and_cut_frames_are_left_out_or_flagged():
    script = f"""
/test/usb_camera --damage 3 --cut 6 --damage 8 --port 1 & plugged_in 0
take 0 {FORMATS['grey']} 10 /left_out
kill $!; wait $! || true
echo 1 > /sys/module/uvcvideo/parameters/nodrop
until [ ! -e /dev/video0 ]; do sleep 0.05; done
/test/usb_camera --damage 3 --cut 6 & plugged_in 0
take 0 {FORMATS['grey']} 10 /flagged --verbose
cp /progress /told"""
    with with_usb_camera(script, fetch=["left_out", "told"]) as (_, folder):
        numbers = numbers_in("grey", folder / "left_out")
        same((len(numbers), rising(numbers), {3, 6, 8} & set(numbers)), (10, True, set()))
        told = re.findall(r"seq: *(\d+) bytesused: (\d+) .*\(error", (folder / "told").read_text())
        same(told, [("3", str(640 * 480)), ("6", str(640 * 240))])


@case
def two_usb_cameras_have_names_and_frames_of_their_own():
    script = f"""
/test/usb_camera --serial left & plugged_in 0
/test/usb_camera --serial right --port 1 --mjpeg /given/* & plugged_in 2
cat /sys/class/video4linux/video0/device/../serial /sys/class/video4linux/video2/device/../serial
take 0 {FORMATS['yuyv']} 6 /left &
take 2 {FORMATS['mjpeg']} 7 /right
wait %3"""
    with tempfile.TemporaryDirectory() as given:
        frames = [bytes([number]) * size for number, size in enumerate((5000, 400000, 1))]
        for number, frame in enumerate(frames):
            (Path(given) / str(number)).write_bytes(frame)
        with with_usb_camera(script, files={"/given": given}, fetch=["left", "right"]) as (said, folder):
            same([line for line in said.splitlines() if "usb" not in line], ["left", "right"])
            same(len(numbers_in("yuyv", folder / "left")), 6)
            same((folder / "right").read_bytes() == b"".join(frames * 2 + frames[:1]), True)


@case
def the_usb_camera_is_unplugged_in_a_stream_and_plugged_in_again():
    script = f"""
/test/usb_camera --unplug-after 7 & plugged_in 0
take 0 {FORMATS['grey']} 20 /first || true
until [ ! -e /dev/video0 ]; do sleep 0.05; done; echo gone
/test/usb_camera & plugged_in 0
take 0 {FORMATS['grey']} 5 /second"""
    with with_usb_camera(script, fetch=["first", "second"]) as (said, folder):
        holds(said, "usb camera: unplugged after 7 frames\n")
        holds(said, "gone\n")
        same(numbers_in("grey", folder / "first")[0], 0)
        same(len(numbers_in("grey", folder / "second")), 5)


if __name__ == "__main__":
    sys.exit(run_cases("cameras of the emulated board", sys.argv[3:]))
