"""A board whose daemon is watched: what the invariants are checked by, and in which rows of the table of faults."""
import re

import invariants
from board_shell import BoardShell
from faults_page import ON_BOARD

CHECKED = {}  # {row of the table of faults: the invariants that were checked in it}


class WatchedBoard(BoardShell):
    """Keeps the record of its run, and checks it at the end.

    process: the daemon's, in words of the board's shell; sudo: what stands before what only root may."""

    def __init__(self, *words, process, sudo="", **options):
        super().__init__(*words, **options)
        self.process, self.sudo = process, sudo
        self.record, self.frames_per_s = invariants.Record(), 0

    def __exit__(self, kind, *error):
        try:
            if kind is None:
                self.pins.changes()
                self.record.pins += self.pins.history
                for row, checked in self.record.rows(invariants.check(self.record)).items():
                    CHECKED.setdefault(row, set()).update(checked)
        finally:
            super().__exit__(kind, *error)

    def line(self):
        line = super().line()
        if line.startswith("{"):
            event = self.events[-1]
            self.record.said.append(event)
            if "interval_us" in event:
                self.frames_per_s = 1000000 / event["interval_us"]
        return line

    def provoke(self, row, onset=None, count=1):
        """A fault of the table is about to be provoked: so many events of its onset must come of it."""
        self.record.faults.append((row, onset, count))

    def hold(self):
        """Notes what the daemon holds of the kernel; nothing may be wrong now. The least of three looks: for as long as it
        is written, the picture of a failure is an open file."""
        folder = f"/proc/{self.process}"
        look = (f"echo $({self.sudo}ls {folder}/fd | wc -l) $({self.sudo}cat {folder}/maps | wc -l) "
                f"$({self.sudo}sed -n 's/^Anonymous: *//p' {folder}/smaps_rollup)")
        looks = [self.run(f"{'sleep 0.1; ' * (number > 0)}{look}")[1][0] for number in range(3)]
        files, mappings, kib = zip(*(map(int, text.split()[:3]) for text in looks))
        self.record.held.append(((min(files), mappings[-1], kib[-1]), len(self.record.said)))

    def count_calls(self, row, where, seconds=2, frames=0):
        """The daemon's system calls a second while that is wrong; frames: so many come in a second."""
        said = self.run(f"{self.sudo}count_calls {self.process} {int(seconds * 1000)}")[1][-1]
        calls, turns, took_us = map(int, re.fullmatch(r"calls (\d+) turns (\d+) us (\d+)", said).groups())
        self.record.calls.append((row, where, calls, turns, took_us / 1e6, frames))
        return calls / took_us * 1e6

    def count_calls_after(self):
        """What a fault has left must not spin either: in peace, for all rows in which nothing was counted yet."""
        counted = {row for row, *_ in self.record.calls}
        left = [row for row in dict.fromkeys(row for row, *_ in self.record.faults) if row not in counted]
        if left:
            self.count_calls(left[0], f"after {' '.join(left)}", 1.5, self.frames_per_s)
            self.record.calls += [(row, *self.record.calls[-1][1:]) for row in left[1:]]


def unlike_the_page(rows, all_run):
    """Prints in which of these rows more was checked than faults_page.py says, or where all cases have run, less."""
    status = 0
    for row in sorted({*CHECKED, *rows} if all_run else CHECKED):
        seen, told = CHECKED.get(row, set()), set(ON_BOARD.get(row, "").split())
        if seen - told or (all_run and told - seen):
            print(f"FAILED {row}: {' '.join(sorted(seen))} were checked, and faults_page.py says {' '.join(sorted(told))}")
            status = 1
    return status
