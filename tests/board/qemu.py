"""The machine that QEMU is to be for a board."""
import shlex

from debian import BoardError

# Without its own tests the kernel's cryptography starts sooner; a panic ends QEMU.
KERNEL_OPTIONS = "console=ttyAMA0 loglevel=5 panic=-1 rdinit=/init cryptomgr.notests"

# An instruction takes 4 ns; where the board has nothing to do, its time is that of the host.
STEADY = "shift=2,sleep=on"


def command(board, kernel):
    options = ["-M", "virt", "-cpu", "cortex-a72"]
    options += ["-accel", "tcg,thread=single", "-icount", STEADY] if board.steady else ["-accel", "tcg,thread=multi"]
    options += ["-smp", board.cpus, "-m", board.memory_mb]
    options += ["-nodefaults", "-no-user-config", "-display", "none", "-no-reboot"]
    options += ["-kernel", kernel, "-initrd", board.folder / "initrd", "-append", KERNEL_OPTIONS]
    options += ["-chardev", f"file,id=console,path={board.folder}/console", "-serial", "chardev:console"]
    options += ["-qmp", f"unix:{board.folder}/qmp,server=on,wait=off"]
    options += ["-qtest", f"unix:{board.folder}/qtest,server=on,wait=off", "-qtest-log", "/dev/null"]
    # Files and no I/O thread: what the board has written is on the host's disk before it goes on.
    options += ["-device", "virtio-serial-pci,ioeventfd=off,max_ports=8"]
    for name in board.channels():
        end = "stdio,signal=off" if name == "stdin" else f"file,path={board.folder}/{name}"
        options += ["-chardev", f"{end},id={name}"]
        options += ["-device", f"virtserialport,chardev={name},name=board.{name}"]
    for number, end in enumerate(board.serial_ends):
        name = f"serial{number}"
        options += ["-chardev", chardev(board, name, end), "-device", f"pci-serial,chardev={name}"]
    options += ["-device", "qemu-xhci,id=usb"] if board.usb_serial_ends else []
    for number, end in enumerate(board.usb_serial_ends):
        name = f"usb_serial{number}"
        options += ["-chardev", chardev(board, name, end)]
        options += ["-device", f"usb-serial,bus=usb.0,always-plugged=on,chardev={name},id={name}"]
    if board.ports:
        forwarded = [f",hostfwd=tcp:127.0.0.1:{ours}-10.0.2.15:{its}" for its, ours in board.ports.items()]
        options += ["-netdev", f"user,id=net,restrict=on{''.join(forwarded)}"]
        options += ["-device", "virtio-net-pci,netdev=net,romfile="]
    for number, disk in enumerate(board.disks):
        options += ["-drive", f"if=none,id=disk{number},format=raw,cache=writeback,file={disk}"]
        options += ["-device", f"virtio-blk-pci,drive=disk{number}"]
    options += ["-incoming", f"exec:cat {shlex.quote(str(board.resume))}"] if board.resume else []
    return ["qemu-system-aarch64", *map(str, options)]


def chardev(board, name, end):
    """The far end of a serial line."""
    if end == "pty":
        return f"pty,id={name}"
    if end == "socket":
        return f"socket,id={name},path={board.folder}/{name},server=on,wait=off"
    if end.startswith("unix:"):
        return f"socket,id={name},path={end[len('unix:'):]},server=on,wait=off"
    raise BoardError(f"a far end is socket, pty or unix:PATH, not {end}")


def vivid_options(cameras, loop):
    """Webcams video0.. of the driver vivid; with loop HDMI inputs, fed by outputs behind them in number."""
    def each(value):
        return ",".join([value] * cameras)

    def numbers(first):
        return ",".join(str(first + number) for number in range(cameras))
    options = {"n_devs": cameras, "node_types": each("0x101" if loop else "0x1"), "vid_cap_nr": numbers(0),
               "num_inputs": each("1"), "input_types": each("0x3" if loop else "0x0")}
    if loop:
        options.update(vid_out_nr=numbers(cameras), num_outputs=each("1"), output_types=each("0x1"))
    return " ".join(f"{name}={value}" for name, value in options.items())
