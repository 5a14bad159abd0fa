#!/usr/bin/env python3
"""The package of fovead for this machine: package_test.py BUILD [WORD...]

BUILD is the folder of a build with -DFOVEA_PACKAGE=ON -DFOVEA_STATIC=ON. The package is made there, unpacked and looked
at; nothing is installed. Wants dpkg, systemd, groff and mandoc; lintian where it is.
"""
import gzip
import json
import re
import shutil
import stat
import subprocess
import sys
import tempfile
from pathlib import Path

sys.dont_write_bytecode = True
ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests/board"))
from cases import case, holds, run_cases, same  # noqa: E402
from daemon_rig import RECIPE  # noqa: E402

MOST_EXPOSURE = 2.0
FILES = {
    "etc/fovea/fovead.toml": 0o644, "usr/bin/fovea": 0o755, "usr/bin/fovead": 0o755,
    "lib/systemd/system/fovead.service": 0o644, "lib/udev/rules.d/60-fovea.rules": 0o644,
    "usr/lib/sysusers.d/fovead.conf": 0o644, "usr/share/man/man1/fovea.1.gz": 0o644,
    "usr/share/man/man5/fovead.conf.5.gz": 0o644, "usr/share/man/man8/fovead.8.gz": 0o644,
    "usr/share/doc/fovead/copyright": 0o644, "usr/share/doc/fovead/changelog.gz": 0o644,
    "usr/share/lintian/overrides/fovead": 0o644,
}
# The address of the package is that of whoever publishes it.
NOT_OURS = r"bogus-mail-host"
work = Path(tempfile.mkdtemp(prefix="package-"))


def run(*words, status=0, **options):
    done = subprocess.run([str(word) for word in words], capture_output=True, text=True, **options)
    if status is not None and done.returncode != status:
        raise AssertionError(f"{words[0]} ended with {done.returncode}: {done.stdout}{done.stderr}")
    return done.stdout + done.stderr


def make(build):
    """The package of a build, and a folder with what is in it."""
    run("cmake", "--build", build, "--target", "fovea", "fovead", "fovead_pages")
    run("cpack", "-G", "DEB", "-B", work / "cpack", cwd=build)
    packages = list((work / "cpack").glob("*.deb"))
    same([re.fullmatch(r"fovead_[\d.]+_\w+\.deb", path.name) is not None for path in packages], [True])
    run("dpkg-deb", "-R", packages[0], work / "root")
    return packages[0], work / "root"


package, root = make(Path(sys.argv[1]).resolve())


@case
def the_package_has_these_files_with_these_modes():
    found = {str(path.relative_to(root)): stat.S_IMODE(path.stat().st_mode) for path in root.rglob("*")
             if path.is_file() and "DEBIAN" not in path.parts}
    same(found, FILES)
    same([path for path in root.rglob("*") if path.is_dir() and stat.S_IMODE(path.stat().st_mode) != 0o755], [])
    same((root / "etc/fovea/jobs").is_dir(), True)
    for line in run("dpkg-deb", "-c", package).splitlines():
        holds(line, " root/root ")


@case
def its_control_files_say_what_it_is():
    same((root / "DEBIAN/conffiles").read_text(), "/etc/fovea/fovead.toml\n")
    for name in ("postinst", "prerm", "postrm"):
        same((name, stat.S_IMODE((root / "DEBIAN" / name).stat().st_mode)), (name, 0o755))
        run("sh", "-n", root / "DEBIAN" / name)
    fields = dict(re.findall(r"^([\w-]+): (.*)", (root / "DEBIAN/control").read_text(), re.M))
    same((fields["Package"], fields["Architecture"]), ("fovead", run("dpkg", "--print-architecture").strip()))
    same("Depends" in fields, False)
    same(fields["Description"], "measures and decides with a camera")
    same((root / "DEBIAN/md5sums").read_text().count("\n"), len(FILES))


@case
def its_programs_need_no_library():
    for name in ("fovea", "fovead"):
        program = root / "usr/bin" / name
        holds(run("ldd", program, status=1), "not a dynamic executable")
        holds(run(program, "--version"), f"{name} {package.name.split('_')[1]}")
    holds(run(root / "usr/bin/fovea", "probe", "--help"), "usage: fovea probe")


@case
def the_settings_that_it_brings_are_good_with_a_job():
    etc = work / "etc"
    shutil.copytree(root / "etc/fovea", etc)
    fovead = root / "usr/bin/fovead"
    holds(run(fovead, "--check-config", "--config", etc / "fovead.toml", status=78), "no job: `fovea teach`")
    (etc / "jobs/disc.toml").write_text(RECIPE)
    same(run(fovead, "--check-config", "--config", etc / "fovead.toml"), f"{etc}/fovead.toml: good, 1 job\n")
    doctor = run(root / "usr/bin/fovea", "doctor", "--json", "--config", etc / "fovead.toml", status=None)
    checks = [json.loads(line) for line in doctor.splitlines()]
    same([(check["check"], check["result"]) for check in checks[:2]], [("settings", "ok"), ("jobs", "ok")])


@case
def the_service_is_closed_as_far_as_it_can_be():
    unit = root / "lib/systemd/system/fovead.service"
    text = unit.read_text()
    for line in ("Type=notify", "WatchdogSec=10", "Restart=always", "RestartSec=500ms", "TimeoutStopSec=5", "RestartPreventExitStatus=64 78",
                 "StartLimitIntervalSec=0", "ExecReload=kill -HUP $MAINPID", "StateDirectory=fovead",
                 "SupplementaryGroups=video dialout gpio", "DevicePolicy=closed", "DeviceAllow=char-video4linux rw"):
        holds(text, f"\n{line}\n")
    told = run("systemd-analyze", "security", "--offline=true", "--no-pager", unit)
    exposure = float(re.search(r"Overall exposure level for fovead.service: ([\d.]+)", told)[1])
    if exposure > MOST_EXPOSURE:
        raise AssertionError(f"an exposure of {exposure}, more than {MOST_EXPOSURE}: {told}")
    # The programs that a unit names must be there, so it is looked at where they are.
    (work / "unit").mkdir()
    (work / "unit/fovead.service").write_text(text.replace("/usr/bin/fovead", str(root / "usr/bin/fovead")))
    told = run("systemd-analyze", "verify", "--recursive-errors=no", "--man=no", work / "unit/fovead.service")
    same([line for line in told.splitlines() if "fovead.service" in line], [])
    print(f"       exposure {exposure}")


@case
def the_rules_of_udev_are_rules():
    keys = (r"(ACTION|SUBSYSTEMS?|KERNEL|ATTR\{\w+\}|ENV\{\w+\})==\"[^\"]+\"|(GROUP|MODE|GOTO|LABEL)=\"[^\"]+\"|"
            r"(SYMLINK|TAG)\+=\"[^\"]+\"|IMPORT\{builtin\}=\"[^\"]+\"")
    text = (root / "lib/udev/rules.d/60-fovea.rules").read_text()
    rules = [line for line in text.split("\n") if line and not line.startswith("#")]
    for rule in rules:
        same((rule, [word for word in rule.split(", ") if not re.fullmatch(keys, word)]), (rule, []))
    same(re.findall(r'GOTO="(\w+)"', text), re.findall(r'LABEL="(\w+)"', text))
    # The serial number is known before it is used.
    same(text.index("usb_id") < text.index("$env{ID_SERIAL_SHORT}"), True)
    holds(text, 'SYMLINK+="fovea/cam-$env{ID_SERIAL_SHORT}"')
    # Only of version 254 and later.
    if "verify" in run("udevadm", "--help", status=None):
        run("udevadm", "verify", root / "lib/udev/rules.d/60-fovea.rules")


@case
def the_users_of_the_service_can_be_made():
    made = work / "users"
    (made / "etc").mkdir(parents=True)
    run("systemd-sysusers", f"--root={made}", root / "usr/lib/sysusers.d/fovead.conf")
    groups = {line.split(":")[0] for line in (made / "etc/group").read_text().splitlines()}
    same({"video", "dialout", "gpio", "fovead"} - groups, set())
    holds((made / "etc/passwd").read_text(), "fovead:x:")


@case
def its_manual_pages_are_set_without_a_warning():
    # mandoc wants a date, which would change with every build, and short lines in the source.
    style = re.compile(r"missing date|STYLE: input text line longer")
    pages = sorted((root / "usr/share/man").rglob("*.gz"))
    same([page.name for page in pages], ["fovea.1.gz", "fovead.conf.5.gz", "fovead.8.gz"])
    for page in pages:
        text = gzip.decompress(page.read_bytes())
        plain = work / page.name[:-3]
        plain.write_bytes(text)
        done = subprocess.run(["groff", "-ww", "-man", "-Tutf8", "-rLL=100n", plain], capture_output=True, text=True)
        same((page.name, done.returncode, done.stderr), (page.name, 0, ""))
        told = run("mandoc", "-Tlint", plain, status=None)
        same((page.name, [line for line in told.splitlines() if not style.search(line)]), (page.name, []))
    keys = set(re.findall(r"^(\w+) = ", (root / "etc/fovea/fovead.toml").read_text(), re.M))
    told = set(re.findall(r"^\.B (\w+)$", (work / "fovead.conf.5").read_text(), re.M))
    same((keys - told, len(keys) > 30), (set(), True))
    # This one is kept in the tree, for it needs the whole tool to be made.
    page = run(root / "usr/bin/fovea", "--manual")
    if page != (ROOT / "apps/tool/fovea.1").read_text():
        raise AssertionError("apps/tool/fovea.1 is not what `fovea --manual` prints: look, then print it there")


@case
def lintian_has_nothing_to_say():
    if shutil.which("lintian") is None:
        print("       skipped: lintian is not installed")
        return
    told = run("lintian", "--allow-root", package, status=None)
    same([line for line in told.splitlines() if re.match("[EW]:", line) and not re.search(NOT_OURS, line)], [])


try:
    status = run_cases("package_test", sys.argv[2:])
    print(f"package_test: {package.name} has {package.stat().st_size} bytes")
finally:
    shutil.rmtree(work)
sys.exit(status)
