"""What a board has in its initial file system."""
import shlex
import shutil
from pathlib import Path

import systemd_files
from debian import BoardError, Packages
from initramfs import Archive

HERE = Path(__file__).resolve().parent
FOLDERS = ("dev", "proc", "run", "sbin", "sys", "tmp", "usr/bin", "usr/sbin", "var")


def busybox(cache):
    """The shell and tools of the board, one program."""
    def fetch(new):
        unpacked = cache.folder / "new.busybox-package"
        Packages(cache).unpack("busybox-static", unpacked)
        (unpacked / "bin/busybox").rename(new)
        shutil.rmtree(unpacked)
    return cache.entry("busybox", fetch)


def package_layer(cache, names):
    """Packages of Debian and what they need, as an archive."""
    name = "+".join(names)

    def fetch(new):
        unpacked = cache.folder / f"new.package-{name}"
        Packages(cache).unpack_with_all_they_need(names, unpacked)
        layer = Archive()
        for entry in sorted(unpacked.iterdir()):
            layer.tree(entry.name, entry)
        new.write_bytes(layer.finished())
        shutil.rmtree(unpacked)
    return cache.entry(f"package-{name}.cpio", fetch)


def own_layer(board, cache, modules):
    """What a run has for itself: modules: files, in the order of loading."""
    layer = Archive()
    for folder in FOLDERS:
        layer.folder(folder)
    layer.file("init", (HERE / "guest_init").read_bytes(), 0o755)
    layer.file("board/run", (HERE / "guest_run").read_bytes())
    layer.file("bin/busybox", busybox(cache).read_bytes(), 0o755)
    if board.systemd:
        systemd_files.add_to(layer)
    else:
        layer.file("etc/passwd", b"root:x:0:0:root:/tmp:/bin/sh\n")
        layer.file("etc/group", b"root:x:0:\ndialout:x:20:\nvideo:x:44:\n")
    layer.file("etc/hosts", b"127.0.0.1 localhost board\n")
    for module in modules:
        layer.file(f"lib/modules/{module.name}", module.read_bytes())
    devices = [f"board.{name}" for name in board.channels()]
    devices += [f"ttyUSB{number}" for number in range(len(board.usb_serial_ends))]
    settings = {"command": [f"cd / && exec {shlex.join(board.command)}"],
                "modules": [f"{module.name} {board.modules.get(module.stem, '')}" for module in modules],
                "fetch": [name.lstrip("/") for name in board.fetch],
                "devices": devices}
    for name, lines in settings.items():
        layer.file(f"board/{name}", "".join(f"{line}\n" for line in lines).encode())
    for name, path in board.files.items():
        if not Path(path).exists():
            raise BoardError(f"no such file: {path}")
        layer.tree(name, Path(path).resolve())
    return layer.finished()
