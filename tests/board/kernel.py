"""Debian's kernel for a board, and its modules in the order in which they can be loaded."""
import re
import shutil

import gpio_sim
from debian import BoardError, Packages

# Found by alias at run time, in the kernel's words a soft dependency.
ALSO = {"ext4": ["crc32c_generic"]}


def plain(name):
    """In a module's name - and _ are the same."""
    return name.replace("-", "_")


class Kernel:
    """The newest that linux-image-arm64 names when the cache is filled. Works on a locked cache."""

    def __init__(self, cache):
        self.cache = cache
        self.folder = cache.entry("kernel", self.fetch)
        self.image = self.folder / "vmlinuz"
        self.version = (self.folder / "version").read_text()
        self.built_in = (self.folder / "built_in").read_text().split()

    def fetch(self, folder):
        packages = Packages(self.cache)
        needed = packages.needs("linux-image-arm64")
        name = next((name for name in needed if re.match(r"linux-image-\d", name)), None)
        if name is None:
            raise BoardError("linux-image-arm64 names no kernel")
        unpacked = self.cache.folder / "new.kernel-package"
        packages.unpack(name, unpacked)
        (folder / "modules").mkdir(parents=True)
        next(unpacked.glob("boot/vmlinuz-*")).rename(folder / "vmlinuz")
        for module in unpacked.rglob("*.ko"):
            module.rename(folder / "modules" / f"{plain(module.stem)}.ko")
        listed = next(unpacked.glob("lib/modules/*/modules.builtin")).read_text()
        (folder / "built_in").write_text(plain(re.sub(r".*/|\.ko$", "", listed, flags=re.M)))
        (folder / "version").write_text(name[len("linux-image-"):])
        shutil.rmtree(unpacked)

    def has(self, name):
        return plain(name) in self.built_in or self.module(name).exists()

    def module(self, name):
        return self.folder / "modules" / f"{plain(name)}.ko"

    def in_order(self, names):
        """Files of the modules and of all they depend on, each after what it needs."""
        files = []
        for name in names:
            if plain(name) == "gpio_sim" and not self.has(name):
                gpio_sim.build(self.cache, self.version, self.folder / "modules")
            if not self.has(name):
                raise BoardError(f"the kernel {self.version} has no module {name}")
            file = self.module(name)
            if plain(name) in self.built_in or file in files:
                continue
            listed = re.search(rb"\0depends=([^\0]*)\0", file.read_bytes())
            needed = [word for word in listed[1].decode().split(",") if word] if listed else []
            for other in self.in_order(needed + ALSO.get(name, [])) + [file]:
                if other not in files:
                    files.append(other)
        return files
