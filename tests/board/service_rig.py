"""The package of fovead on an emulated board with systemd and udev, and a person who may use sudo."""
import re
from pathlib import Path

from watched import WatchedBoard

HOME = "/srv/person"
# As tests/run fetches them before.
PACKAGES = ["dpkg", "libc-bin", "procps", "sudo", "v4l-utils"]
# What Debian's own packages and its installer would have made: the data of dpkg, a person in the group of
# cameras, and sudo that asks for no password.
PREPARE = f"""
mkdir -p {HOME} /var/lib/dpkg/info /var/lib/dpkg/updates /var/log
touch /var/lib/dpkg/status
echo 'person:x:1000:1000::{HOME}:/bin/dash' >> /etc/passwd
echo 'person:x:1000:' >> /etc/group
sed -i 's/^video:.*/&person/' /etc/group
chown person:person {HOME}
for stack in auth account password session session-noninteractive; do
  echo "${{stack%%-*}} required pam_permit.so" > /etc/pam.d/common-$stack
done
echo 'person ALL=(ALL) NOPASSWD: ALL' > /etc/sudoers.d/person
chmod 440 /etc/sudoers.d/person
cd {HOME}
exec su person
"""


class ServiceRig(WatchedBoard):
    """The shell is the person's; settings and jobs are those that the package brings."""

    def __init__(self, package, texts, **options):
        """package: the .deb, which is at the person's home; texts: {path on the board: what stands there}."""
        super().__init__(["sh", "-c", PREPARE], process="$(sudo systemctl show --value -p MainPID fovead)", sudo="sudo ", systemd=True, packages=PACKAGES,
                         seconds=240, **options)
        files = self.options.setdefault("files", {})
        files[f"{HOME}/{package.name}"] = package
        for number, (path, text) in enumerate(texts.items()):
            files[path] = Path(self.folder.name) / str(number)
            files[path].write_text(text)
        self.package = package.name

    def must(self, command):
        """The lines of a command that does not fail."""
        status, lines = self.run(command)
        if status != 0:
            raise AssertionError(f"{command} ended with {status}: {lines} {self.board.stderr.everything().decode()[-2000:]}"
                                 f"{self.journal()}")
        return lines

    def text(self, command):
        return "".join(f"{line}\n" for line in self.must(command))

    def journal(self):
        return "\n".join(self.run("sudo journalctl -u fovead -o short-monotonic --no-pager | cut -c 1-160 | tail -n 30")[1])

    def told_us(self, words):
        """When systemd last said something of the service, as the daemon tells its times."""
        line = self.must(f"sudo journalctl -u fovead -o short-monotonic --no-pager | grep -F ']: {words}'")[-1]
        return round(float(re.match(r"\[ *([\d.]+)\]", line)[1]) * 1000000)

    def install(self):
        return self.text(f"sudo dpkg -i {self.package} 2>&1")

    def follow(self, command="sudo journalctl -u fovead -o cat -f -n 0"):
        """What the service says comes as events; what systemd says of it stays in the journal."""
        self.tell(f"{command} _TRANSPORT=stdout &")

    def change(self, table, **keys):
        """Changes keys of a table in the settings that were installed."""
        words = "; ".join(f"s|^{name} = .*|{name} = {value}|" for name, value in keys.items())
        before = self.text("cat /etc/fovea/fovead.toml")
        self.must(f"sudo sed -i '/^.{table}]/,/^.[a-z]*]/ {{ {words} }}' /etc/fovea/fovead.toml")
        after = self.text("cat /etc/fovea/fovead.toml")
        changed = sum(old != new for old, new in zip(before.split("\n"), after.split("\n")))
        if changed != len(keys):
            raise AssertionError(f"of {list(keys)} in [{table}] {changed} have changed")

    def shown(self, *names):
        """Properties of the service."""
        lines = self.must(f"sudo systemctl show fovead {' '.join(f'-p {name}' for name in names)}")
        return dict(line.split("=", 1) for line in lines)
