"""Cases of a test: functions that raise an error where something is not as it must be."""
import time
from concurrent.futures import ThreadPoolExecutor

cases = []


def case(function):
    cases.append(function)
    return function


def same(seen, wanted):
    if seen != wanted:
        raise AssertionError(f"{wanted!r} was expected, {seen!r} came")


def holds(text, words):
    if words not in text:
        raise AssertionError(f"'{words}' is not in {text!r}")


def tried(function):
    begin = time.monotonic()
    try:
        function()
        fault = ""
    except Exception as error:  # one case's fault is told, and the others run
        fault = f"\n       {type(error).__name__}: {error}"
    seconds = time.monotonic() - begin
    print(f"{'FAILED' if fault else 'ok':6s} {seconds:5.1f} s  {function.__name__}{fault}", flush=True)
    return not fault


def run_cases(name, words, at_once=2):
    """Some at a time; with words only those whose names hold one of them. The status of the program."""
    chosen = [function for function in cases if not words or any(word in function.__name__ for word in words)]
    with ThreadPoolExecutor(at_once) as pool:
        verdicts = list(pool.map(tried, chosen))
    print(f"{name}: {sum(verdicts)} passed, {verdicts.count(False)} failed")
    return 0 if verdicts and all(verdicts) else 1
