"""The pins of an emulated board, driven and seen from outside."""
import collections
import threading
import time

DATA, DIRECTION = 0x90303FC, 0x9030400  # registers of QEMU's board "virt"


class Pins:
    """The eight lines of the board's PL061 over QEMU's test socket. It sees changes from when it was made: a thread hears
    them, for QEMU waits with the whole board for who does not."""

    def __init__(self, world, machine):
        """world: the test socket, connected; machine: what answers to commands of QMP."""
        objects = machine("qom-list", path="/machine/unattached")
        name = next(entry["name"] for entry in objects if entry["type"] == "child<pl061>")
        self.path = f"/machine/unattached/{name}"
        self.world, self.answers, self.events, self.ended = world, [], collections.deque(), False
        self.history = []  # of all changes
        self.came = threading.Condition()
        threading.Thread(target=self.listen, daemon=True).start()
        self.tell(f"irq_intercept_out {self.path}")

    def drive(self, line, level):
        """Puts a level on an input."""
        self.tell(f"set_irq_in {self.path} unnamed-gpio-in {line} {int(level)}")

    def outputs(self):
        """{line: level} of the lines that are outputs."""
        levels, outputs = (int(self.tell(f"readl {register:#x}")[0], 16) for register in (DATA, DIRECTION))
        return {line: levels >> line & 1 for line in range(8) if outputs >> line & 1}

    def changes(self):
        """[(line, level)] of outputs since the last call, in order."""
        self.tell(f"readl {DATA:#x}")  # its answer comes behind them
        with self.came:
            seen = list(self.events)
            self.events.clear()
        return seen

    def wait_for(self, line, level, seconds=10):
        """Takes changes until this one comes: is it seen in time?"""
        return self.changes_until(line, level, seconds) is not None

    def changes_until(self, line, level, seconds=10):
        """The changes up to this one, with it; None if it does not come in time."""
        seen, end = [], time.monotonic() + seconds
        with self.came:
            while True:
                while self.events:
                    seen.append(self.events.popleft())
                    if seen[-1] == (line, level):
                        return seen
                if self.ended or not self.came.wait(max(end - time.monotonic(), 0)):
                    return None

    def whole_history(self):
        """All changes, once the board has ended."""
        with self.came:
            self.came.wait_for(lambda: self.ended)
        return self.history

    def tell(self, command):
        self.world.sendall(f"{command}\n".encode())
        with self.came:
            self.came.wait_for(lambda: self.answers or self.ended)
            if not self.answers:
                raise ConnectionError("the board has ended")
            answer = self.answers.pop(0)
        if answer[0] != "OK":
            raise OSError(f"{command}: {answer}")
        return answer[1:]

    def listen(self):
        """Sorts what QEMU says into answers and events."""
        unread = b""
        while data := self.heard():
            *lines, unread = (unread + data).split(b"\n")
            with self.came:
                for words in (line.decode().split() for line in lines):
                    if words[0] == "IRQ":
                        self.events.append((int(words[2]), int(words[1] == "raise")))
                        self.history.append(self.events[-1])
                    else:
                        self.answers.append(words)
                self.came.notify_all()
        with self.came:
            self.ended = True
            self.came.notify_all()

    def heard(self):
        try:
            return self.world.recv(4096)
        except OSError:
            return b""  # closed on this side
