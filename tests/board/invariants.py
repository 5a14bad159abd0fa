#!/usr/bin/env python3
"""What holds of every run of the daemon, whatever is wrong around it: I1 to I6 of docs/faults.md. I7 is about
times to a few per cent, which a board that is software does not keep: it is checked where time is simulated.

A Record has all that a run gave, seen from outside: what the daemon said, its pins, its serial line, what the
kernel counts of it. check() raises an error where an invariant does not hold of it, and tells which applied.

usage: invariants.py FILE    checks a record that is kept as JSON
"""
import json
import re
import sys

READY, BUSY, VALID, OK, NG, ALARM = 1, 2, 4, 5, 6, 7
JUDGED = ("OK", "NG")
COUNTS = ("OK", "NG", "ERROR", "MISSED")
# Trouble and its end, in the words of events. What follows from a trouble of the camera may be another of it.
ENDS = {"serial_lost": "serial_back", "image_quality": "image_quality_back", "failures_lost": "failures_kept",
        "lines_lost": "lines_back", "trigger_lost": "no end: the line is opened by the next start",
        **{f"camera_{word}": "camera_back" for word in
           ("lost", "broken", "silent", "no_signal", "changed", "refused")}}
CALLS_PER_S = 20  # while it waits for recovery
KIB_MORE = 64  # of memory that is touched for the first time


class Record:
    """A run, from the first start of the daemon to its end. Reading settings anew begins another session in it."""

    def __init__(self):
        self.said = []  # events, in order
        self.pins = []  # (line, level), in order
        self.records = []  # of the serial line: "number;verdict;..."
        self.asked = []  # answers to STAT?
        self.stamped_at_end = True  # frames, as vivid does; a USB camera's when they begin
        self.edges = None  # that were driven on the trigger's line, if it listens to one
        self.held = []  # ((files, mappings, KiB), how many events came before)
        self.calls = []  # (row, where, calls, turns, seconds, frames/s that may come): while something is away
        self.faults = []  # (row, onset, how many) as they were provoked
        self.latencies = {}  # {where: [microseconds]}, for the figures

    def rows(self, applied):
        """{row: the invariants that were checked in it}, of those that applied to all; calls are counted in some."""
        counted = {row for row, *_ in self.calls}
        return {row: {name for name in applied if name != "I5" or row in counted} for row, _, _ in self.faults}

    def sessions(self):
        """Events by session; a start begins one."""
        found = []
        for event in self.said:
            if event["ev"] == "start" or not found:
                found.append([])
            found[-1].append(event)
        return found

    def lives(self):
        """Events of each process: numbers and statistics go on where it reads its settings anew."""
        found = []
        for session in self.sessions():
            if found and len(session) > 1 and session[1]["ev"] in ("reload", "reload_failed"):
                found[-1] += session
            else:
                found.append(session)
        return found


def check(record):
    """The invariants that applied; an AssertionError for the first that does not hold."""
    applied = set()
    for name, rule in RULES.items():
        complaint = rule(record)
        if complaint:
            raise AssertionError(f"{name}: {complaint}")
        if complaint is not None:
            applied.add(name)
    return applied


# ---- The rules: None where there is nothing to look at, "" where it holds, or what is wrong ------------------


def answers(events):
    """(number, verdict) of every trigger that was answered, as it was said: one that is missed while another is
    judged before that one."""
    return [(event["seq"], event.get("verdict", "MISSED")) for event in events
            if event["ev"] in ("result", "trigger_missed")]


def every_trigger_has_one_answer(record):
    lives = [answers(session) for session in record.lives()]
    if not any(lives):
        return None
    for seen in lives:
        numbers = [number for number, _ in seen]
        if sorted(numbers) != list(range(1, len(numbers) + 1)):
            return f"triggers are numbered {numbers}"
        judged = [number for number, verdict in seen if verdict != "MISSED"]
        if judged != sorted(judged):
            return f"results are not in order: {judged}"
        if strange := [verdict for _, verdict in seen if verdict not in COUNTS]:
            return f"answers {strange}"
    total = sum(map(len, lives))
    if record.edges is not None and record.edges != total:
        return f"{record.edges} edges, {total} answers"
    for text, events_before in record.asked:
        told = {word: int(count) for word, count in re.findall(r"(triggers|ok|ng|error|missed) (\d+)", text)}
        if told["triggers"] != told["ok"] + told["ng"] + told["error"] + told["missed"]:
            return f"does not add up: {text}"
        last = Record()
        last.said = record.said[:events_before]
        seen = [verdict for _, verdict in answers(last.lives()[-1])]
        counted = {word: seen.count(word.upper()) for word in ("ok", "ng", "error", "missed")}
        if counted != {word: told[word] for word in counted}:
            return f"{counted} were said, and to STAT? {told}"
    # A record may have been dropped; none may say what the others do not.
    known = {answer for life in lives for answer in life}
    sent = [(int(number), verdict) for number, verdict in (text.split(";")[:2] for text in record.records)]
    if wrong := [pair for pair in sent if pair not in known]:
        return f"on the serial line alone: {wrong}"
    if len(lives) == 1 and sorted(set(sent)) != sent:
        return f"records are not in order: {sent}"
    return ""


def no_verdict_of_a_bad_frame(record):
    if not any(event.get("verdict") in JUDGED for event in record.said):
        return None
    for session in record.sessions():
        trouble, last = None, None
        interval_us = next((event["interval_us"] for event in session if "interval_us" in event), 0)
        for event in session:
            if event["ev"].startswith("camera_"):
                trouble, last = (None, None) if event["ev"] == "camera_back" else (event["ev"], None)
            if event.get("verdict") not in JUDGED:
                continue
            told, frame = f"{event['verdict']} of trigger {event['seq']}", event["frame"]
            if trouble:
                return f"{told} while {trouble}"
            if frame is None or frame["age_us"] < 0:
                return f"{told} of the frame {frame}"
            if last is not None and not 0 < (frame["seq"] - last) % 2**32 < 2**31:
                return f"{told} of frame {frame['seq']}, which is not after frame {last}"
            last = frame["seq"]
            # When the frame began, later by what passed between two looks at the clock.
            begun_us = event["t_mono_us"] - event["us"]["judge"] - frame["age_us"]
            begun_us -= interval_us if record.stamped_at_end else 0
            trigger_us = event["t_mono_us"] - event["us"]["answer"]
            if record.edges is not None and begun_us < trigger_us:
                return f"{told}: its frame began {trigger_us - begun_us} us before it"
    return ""


def lines_are_clear(record):
    if not record.pins:
        return None
    level = dict.fromkeys(range(8), 0)
    for place, (line, value) in enumerate(record.pins):
        if level[VALID] and line in (OK, NG) and level[line] != value:
            return f"change {place}: OK or NG changed while VALID was active"
        level[line] = value
        if level[OK] and level[NG]:
            return f"change {place}: OK and NG together"
        if level[VALID] and level[OK] == level[NG]:
            return f"change {place}: VALID with neither"
        if level[READY] and level[BUSY]:
            return f"change {place}: READY and BUSY together"
    return ""


def all_is_given_back(record):
    """Of each session, what it held when it had judged once, and whenever it was looked at again in peace. Settings
    read anew may be of other jobs, which take other memory; the files are as many."""
    base, compared = {}, False
    for (files, mappings, kib), before in record.held:
        session = sum(event["ev"] == "start" for event in record.said[:before])
        first = not base
        compared = compared or not first
        if not first and files != next(iter(base.values()))[0]:
            return f"{next(iter(base.values()))[0]} files were open, and are {files}"
        if session not in base:
            base[session] = (files, mappings, kib)
            continue
        if mappings != base[session][1] or kib > base[session][2] + KIB_MORE:
            return f"mappings and KiB were {base[session][1:]}, and are {(mappings, kib)}"
    return "" if compared else None


def nothing_spins(record):
    if not record.calls:
        return None
    for _, where, calls, turns, seconds, frames in record.calls:
        # Where frames come, each is a turn of the loop, which has its work to do; no other turns may be made.
        extra, what = (calls, "calls") if frames == 0 else (turns - frames * seconds, "turns that no frame brought")
        if extra > CALLS_PER_S * seconds:
            return f"{where}: {extra:.0f} {what} in {seconds:.1f} s"
    return ""


def faults_are_told_once(record):
    provoked, seen = {}, {}
    for row, onset, count in record.faults:
        if onset:
            provoked[onset] = provoked.get(onset, 0) + count
    if not record.said:
        return None
    for session in record.sessions():
        open_troubles = {}
        for event in session:
            word = event["ev"]
            if word in ENDS:
                family = ENDS[word]
                if open_troubles.get(family) == word:
                    return f"{word} twice without an end: {event}"
                if family in open_troubles and family != "camera_back":
                    return f"{word} within {open_troubles[family]}"
                if not re.search(r"[a-z]{3}", event.get("reason", "")):
                    return f"no reason: {event}"
                open_troubles[family] = word
                seen[word] = seen.get(word, 0) + 1
            elif word in ENDS.values():
                if word not in open_troubles:
                    return f"{word} of no trouble"
                del open_troubles[word]
        left = {word for word in open_troubles.values() if "no end" not in ENDS[word]}
        if left:
            return f"no end of {left}"
    if seen != provoked:
        return f"{provoked} were provoked, {seen} told"
    return ""


RULES = {"I1": every_trigger_has_one_answer, "I2": no_verdict_of_a_bad_frame, "I3": lines_are_clear,
         "I4": all_is_given_back, "I5": nothing_spins, "I6": faults_are_told_once}


def main():
    record = Record()
    with open(sys.argv[1]) as file:
        for name, value in json.load(file).items():
            getattr(record, name)  # it must be one of a record's
            setattr(record, name, value)
    try:
        print(f"{' '.join(sorted(check(record)))} hold")
    except AssertionError as error:
        sys.exit(f"invariants: {error}")


if __name__ == "__main__":
    main()
