"""Debian's packages for a board, fetched with an index of their own: the host's packages are not touched.

Everything is made below a name that begins with "new." and then renamed, while the cache is locked: runs may
be started side by side and stopped at any time, and a full cache needs no network.
"""
import contextlib
import fcntl
import os
import shutil
import subprocess
from pathlib import Path

PROJECT = Path(__file__).resolve().parents[2]
# What no program of a board reads.
NOT_NEEDED = ("usr/share/doc", "usr/share/man", "usr/share/locale", "usr/share/info", "usr/share/lintian",
              "usr/lib/*/gconv", "usr/lib/*/perl-base", "usr/share/perl*", "lib/udev/hwdb.d", "usr/lib/udev/hwdb.d")


class BoardError(Exception):
    """What was asked for cannot be had; the text says what and why."""


def run(command, folder=None):
    done = subprocess.run(command, cwd=folder, stdin=subprocess.DEVNULL, capture_output=True, text=True)
    if done.returncode != 0:
        end = "\n".join((done.stdout + done.stderr).splitlines()[-20:])
        raise BoardError(f"{' '.join(map(str, command[:2]))} failed:\n{end}")
    return done.stdout


class Cache:
    """A folder that outlives the runs: $FOVEA_BOARD_CACHE or build/board-cache."""

    def __init__(self):
        self.folder = Path(os.environ.get("FOVEA_BOARD_CACHE") or PROJECT / "build/board-cache").resolve()
        self.folder.mkdir(parents=True, exist_ok=True)

    @contextlib.contextmanager
    def locked(self):
        with (self.folder / "lock").open("w") as lock:
            fcntl.flock(lock, fcntl.LOCK_EX)
            for left in self.folder.glob("new.*"):
                shutil.rmtree(left) if left.is_dir() else left.unlink()
            yield

    def entry(self, name, make):
        """The file or folder NAME, which make(path) makes if it is not there."""
        path = self.folder / name
        if not path.exists():
            new = self.folder / f"new.{name}"
            make(new)
            new.rename(path)
        return path


class Packages:
    """Debian's packages of one architecture. Works on a locked cache."""

    def __init__(self, cache, architecture="arm64"):
        self.cache, self.architecture = cache, architecture
        self.folder = cache.folder / f"apt-{architecture}"

    def apt(self, tool, *words, folder=None, index=None):
        index = index or self.folder
        places = {"State": "state", "State::status": "status", "Cache": "cache"}
        options = {"APT::Architecture": self.architecture, "APT::Architectures": self.architecture,
                   **{f"Dir::{key}": index / place for key, place in places.items()},
                   "Debug::NoLocking": 1, "APT::Sandbox::User": "", "APT::Install-Recommends": 0,
                   "Acquire::Languages": "none", "Acquire::Retries": 2, "Acquire::http::Timeout": 30}
        return run([tool, "-q", *(f"-o{key}={value}" for key, value in options.items()), *words], folder)

    def index(self):
        """Reads the index, unless it was read before."""
        def make(new):
            for place in ("state/lists/partial", "cache/archives/partial"):
                (new / place).mkdir(parents=True)
            (new / "status").touch()
            self.apt("apt-get", "update", index=new)
        self.cache.entry(self.folder.name, make)

    def forget_index(self):
        shutil.rmtree(self.folder, ignore_errors=True)

    def get(self, *words, folder=None):
        """apt-get WORDS; once more with a new index if the old one names what is no longer there."""
        fresh = not self.folder.exists()
        self.index()
        try:
            self.apt("apt-get", *words, folder=folder)
        except BoardError:
            if fresh:
                raise
            self.forget_index()
            self.index()
            self.apt("apt-get", *words, folder=folder)

    def needs(self, name):
        """The packages that a package depends on directly."""
        self.index()
        lines = self.apt("apt-cache", "depends", name).splitlines()
        return [line.split(": ")[1] for line in lines if line.strip().startswith("Depends: ")]

    def unpack(self, name, folder):
        """The files of one package, without what it depends on."""
        with self.work_folder() as work:
            self.get("download", name, folder=work)
            self.extract(work, folder)

    def unpack_with_all_they_need(self, names, folder):
        """Packages and what apt would add to them on an empty system."""
        self.index()
        archives = self.folder / "cache/archives"
        for old in archives.glob("*.deb"):
            old.unlink()
        self.get("install", "-y", "--download-only", *names)
        self.extract(archives, folder)
        for unread in NOT_NEEDED:
            for path in folder.glob(unread):
                shutil.rmtree(path)

    def extract(self, archives, folder):
        found = sorted(archives.glob("*.deb"))
        if not found:
            raise BoardError(f"no package was downloaded to {archives}")
        for archive in found:
            run(["dpkg-deb", "-x", archive, folder])
            archive.unlink()

    @contextlib.contextmanager
    def work_folder(self):
        folder = self.cache.folder / "new.packages"
        folder.mkdir()
        try:
            yield folder
        finally:
            shutil.rmtree(folder)
