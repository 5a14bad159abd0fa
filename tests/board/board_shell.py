"""A board with a shell that is told what to do, while fovead says its events beside it."""
import json
import subprocess
import tempfile

from emulated_board import EmulatedBoard


class BoardShell:
    """shell: its words. folder is one of the host, for what goes into the board; it goes with the board."""

    def __init__(self, shell, **options):
        self.shell, self.options = shell, options
        self.folder = tempfile.TemporaryDirectory()
        self.events, self.commands, self.waits_for = [], 0, None

    def __enter__(self):
        self.board = EmulatedBoard(self.shell, stdin=subprocess.PIPE, **self.options)
        self.board.__enter__()
        self.pins = self.board.pins
        return self

    def __exit__(self, *error):
        try:
            return self.board.__exit__(*error)
        finally:
            self.folder.cleanup()

    def line(self):
        """The next line of anybody on the board; what fovead said is kept as events."""
        line = self.board.stdout.line()
        if line is None:
            self.board.wait()
            raise AssertionError(f"the board has ended while {self.waits_for} was waited for: "
                                 f"{self.board.stderr.everything().decode()}{self.board.trouble}")
        if line.startswith("{"):
            self.events.append(json.loads(line))
        return line

    def tell(self, command):
        self.board.process.stdin.write(f"{command}\n".encode())
        self.board.process.stdin.flush()

    def run(self, command):
        """(status, lines) of a command on the board."""
        self.commands += 1
        mark = f"@{self.commands}"
        self.tell(f"{command}\necho {mark} $?")
        self.waits_for = command
        lines = []
        while True:
            line = self.line()
            if line.startswith(mark + " "):
                return int(line.split()[1]), lines
            if not line.startswith("{"):
                lines.append(line)

    def event(self, *kinds):
        """The next event of one of these kinds; those before it are gone."""
        while True:
            self.waits_for = kinds
            while self.events:
                event = self.events.pop(0)
                if event["ev"] in kinds:
                    return event
            self.line()
