"""The module gpio-sim, which Debian's kernel lacks, built from Debian's source of that kernel: pins with
names, and more than the board's eight. Wants make and gcc-aarch64-linux-gnu on the host.
"""
import shutil
import tarfile

from debian import Packages, run

SOURCES = ("drivers/gpio/gpio-sim.c", "drivers/gpio/gpiolib.h", "kernel/irq/irq_sim.c")


def build(cache, version, modules):
    """Puts the module and irq_sim, which it needs, into the folder of modules. Works on a locked cache."""
    folder = cache.folder / "new.gpio-sim"
    release = ".".join(version.split(".")[:2])
    host = run(["dpkg", "--print-architecture"]).strip()
    packages = Packages(cache)
    for name in (f"linux-headers-{version}", f"linux-headers-{version.removesuffix('-arm64')}-common",
                 f"linux-source-{release}"):
        packages.unpack(name, folder)
    Packages(cache, host).unpack(f"linux-kbuild-{release}", folder)

    # The headers name each other by where they would be installed.
    headers = folder / f"usr/src/linux-headers-{version}"
    makefile = headers / "Makefile"
    makefile.write_text(makefile.read_text().replace("/usr/src/", f"{folder}/usr/src/"))

    module = folder / "module"
    module.mkdir()
    with tarfile.open(folder / f"usr/src/linux-source-{release}.tar.xz") as source:
        for member in source:
            name = member.name.partition("/")[2]
            if name in SOURCES:
                (module / name.rpartition("/")[2]).write_bytes(source.extractfile(member).read())
    # It is otherwise a part of the kernel: a module may not call irq_to_desc, and need not.
    irq_sim = (module / "irq_sim.c").read_text()
    irq_sim = irq_sim.replace("handle_simple_irq(irq_to_desc(irqnum));", "generic_handle_irq(irqnum);")
    (module / "irq_sim.c").write_text(irq_sim + '#include <linux/module.h>\nMODULE_LICENSE("GPL");\n')
    (module / "Kbuild").write_text("obj-m := irq_sim.o gpio-sim.o\n")
    run(["make", "-C", headers, f"M={module}", "ARCH=arm64", "CROSS_COMPILE=aarch64-linux-gnu-", "modules"])
    (module / "irq_sim.ko").rename(modules / "irq_sim.ko")
    (module / "gpio-sim.ko").rename(modules / "gpio_sim.ko")
    shutil.rmtree(folder)
