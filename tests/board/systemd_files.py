"""What a board with systemd has beside Debian's packages: the files that their scripts would have made, and units.

systemd is the first process, udev sets the rights of devices, and the journal keeps what services say. What a board
has no use for is masked, for each unit costs its time.
"""
from pathlib import Path

HERE = Path(__file__).resolve().parent
# The last stands for a script that moves files about, and without it perl would come.
PACKAGES = ("systemd", "udev", "base-passwd", "dash", "usr-is-merged")
MASKED = (
    "cryptsetup.target", "dev-hugepages.mount", "dev-mqueue.mount", "getty.target", "integritysetup.target",
    "kmod-static-nodes.service", "ldconfig.service", "proc-sys-fs-binfmt_misc.automount", "remote-fs.target",
    "swap.target", "sys-fs-fuse-connections.mount", "sys-kernel-config.mount", "sys-kernel-debug.mount",
    "sys-kernel-tracing.mount", "systemd-ask-password-console.path", "systemd-ask-password-wall.path",
    "systemd-binfmt.service", "systemd-boot-system-token.service", "systemd-firstboot.service",
    "systemd-hwdb-update.service", "systemd-initctl.socket", "systemd-journal-flush.service",
    "systemd-journald-audit.socket", "systemd-logind.service", "systemd-machine-id-commit.service",
    "systemd-modules-load.service", "systemd-networkd.service", "systemd-pcrphase-sysinit.service",
    "systemd-pcrphase.service", "systemd-pstore.service", "systemd-random-seed.service",
    "systemd-remount-fs.service", "systemd-repart.service", "systemd-sysctl.service", "systemd-sysusers.service",
    "systemd-tmpfiles-clean.timer", "systemd-tmpfiles-setup-dev.service", "systemd-tmpfiles-setup.service",
    "systemd-update-done.service", "systemd-update-utmp-runlevel.service", "systemd-update-utmp.service",
    "systemd-user-sessions.service", "veritysetup.target")
# These make units of what this board has none of, such as an fstab.
GENERATORS = ("cryptsetup", "debug", "fstab", "getty", "gpt-auto", "hibernate-resume", "integritysetup", "rc-local", "run",
              "system-update", "sysv", "veritysetup")
# udev looks again at what was there before it: at devices of ours, and not at a hundred consoles.
COLDPLUG = """[Service]
ExecStart=
ExecStart=udevadm trigger --action=add --subsystem-match=gpio --subsystem-match=video4linux
ExecStart=udevadm trigger --action=add --sysname-match=tty[A-Z]*
"""


def add_to(layer):
    """Puts them into an archive."""
    for name in MASKED:
        layer.link(f"etc/systemd/system/{name}", "/dev/null")
    for name in GENERATORS:
        layer.link(f"etc/systemd/system-generators/systemd-{name}-generator", "/dev/null")
    layer.file("etc/systemd/system/board.service", (HERE / "board.service").read_bytes())
    layer.link("etc/systemd/system/multi-user.target.wants/board.service", "../board.service")
    layer.link("etc/systemd/system/default.target", "/lib/systemd/system/multi-user.target")
    layer.file("etc/systemd/system/systemd-udev-trigger.service.d/board.conf", COLDPLUG.encode())
    layer.file("etc/machine-id", b"f0ea" * 8 + b"\n")
    layer.file("etc/hostname", b"board\n")
