"""The initial file system of a board: cpio archives of the kind "newc", one behind the other."""
import os
import stat
from pathlib import Path, PurePosixPath

ALIGNMENT = 4
FIELDS = ("inode", "mode", "user", "group", "links", "time", "size", "major", "minor", "device_major",
          "device_minor", "name_size", "checksum")


class Archive:
    """Files, folders and links by their paths on the board; the folders above them are made too."""

    def __init__(self):
        self.data = bytearray()
        self.names = set()

    def entry(self, name, mode, content=b""):
        name = str(PurePosixPath("/") / name)[1:]
        if not name or name in self.names and stat.S_ISDIR(mode):
            return
        self.entry(os.path.dirname(name), stat.S_IFDIR | 0o755)
        self.names.add(name)
        self.write(name, mode, content)

    def write(self, name, mode, content):
        path = name.encode() + b"\0"
        values = dict.fromkeys(FIELDS, 0)
        values.update(inode=len(self.names), mode=mode, links=1, size=len(content), name_size=len(path))
        self.data += b"070701" + b"".join(b"%08x" % values[field] for field in FIELDS) + path
        self.align()
        self.data += content
        self.align()

    def align(self):
        self.data += bytes(-len(self.data) % ALIGNMENT)

    def folder(self, name):
        self.entry(name, stat.S_IFDIR | 0o755)

    def file(self, name, content, mode=0o644):
        self.entry(name, stat.S_IFREG | mode, content)

    def link(self, name, target):
        self.entry(name, stat.S_IFLNK | 0o777, target.encode())

    def tree(self, name, path):
        """A file or folder of the host, with its modes and links, under NAME."""
        path = Path(path)
        status = path.lstat()
        if stat.S_ISLNK(status.st_mode):
            self.entry(name, status.st_mode, os.readlink(path).encode())
        elif stat.S_ISREG(status.st_mode):
            self.entry(name, status.st_mode, path.read_bytes())
        elif stat.S_ISDIR(status.st_mode):
            self.entry(name, status.st_mode)
            for inside in sorted(path.iterdir()):
                self.tree(f"{name}/{inside.name}", inside)

    def finished(self):
        self.write("TRAILER!!!", 0, b"")
        return bytes(self.data)
