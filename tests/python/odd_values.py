"""Calls everything that the package exports with odd values, by the signatures of its stubs.

    python3 odd_values.py SEED SECONDS

Each call has to end within a few seconds, in an answer or an ordinary exception, with the
process alive. The last line that is printed names the call that did not.
"""

import ast
import importlib.resources
import os
import random
import re
import signal
import sys
import tempfile
import time
import warnings

import numpy as np

import handway
from cells import can_on_table

LONGEST_CALL = 5.0  # s; a call that is longer is interrupted, and has to end soon then
LONGEST_END = 5.0  # s


def settings_of(owner, function, arguments):
    """Names of the settings that a stub has as **settings; the docstring lists them."""
    if function.args.kwarg is None:
        return []
    text = getattr(getattr(handway, owner), function.name).__doc__
    return [key for key in re.findall(r"^(\w+): ", text, re.MULTILINE) if key not in arguments]


def stubbed_functions():
    """(owner, name, arguments, settings) of all functions, methods and classes' constructors."""
    text = importlib.resources.files(handway).joinpath("__init__.pyi").read_text()
    for node in ast.parse(text).body:
        if isinstance(node, ast.FunctionDef):
            yield None, node.name, [a.arg for a in node.args.args + node.args.kwonlyargs], []
        elif isinstance(node, ast.ClassDef):
            yield None, node.name, [], []
            for member in node.body:
                if isinstance(member, ast.FunctionDef):
                    arguments = [a.arg for a in member.args.args[1:] + member.args.kwonlyargs]
                    settings = settings_of(node.name, member, arguments)
                    yield node.name, member.name, arguments, settings
                elif isinstance(member, ast.AnnAssign):
                    yield node.name, member.target.id, None, []


def uninitialised():
    for name in handway.__all__:
        cls = getattr(handway, name)
        if isinstance(cls, type):
            try:
                yield cls.__new__(cls)
            except TypeError:
                pass


def good_values():
    scene = can_on_table()
    q = np.zeros(len(scene.variables))
    return [
        scene,
        scene.planner(),
        handway.planner("rrt-connect"),
        q,
        np.stack([q, q + 0.1]),
        np.eye(4),
        scene.variables,
        "can",
        "csv",
        "auto",
        "sah_right",
        {"joint_1": 0.1},
        0.5,
        1,
    ]


ODD = [
    None, True, -1, 0, 1, 2, 2**31, 2**63, -(2**63), 1e308, -1e308, 5e-324, float("nan"),
    float("inf"), 1j, "", " ", "\0", "a\0b.csv", "\ud800", "é" * 300, "../..", "/", b"", b"\xff",
    [], [[]], (), {}, {"a": 1}, {"": ""}, {1: 2}, [None], ["a", 1], [1.0, "x"], object(), int,
    lambda *a: a, range(3), set(), np.zeros(0), np.zeros((0, 19)), np.zeros((3, 0)),
    np.zeros((1, 1, 1)), np.full(19, np.nan), np.full(19, np.inf), np.full(19, 1e300),
    np.zeros(19, dtype=complex) + 1j, np.array(["a", "b"]), np.array([None] * 19),
    np.zeros(19, dtype="datetime64[s]"), np.zeros((19, 2))[:, ::2], np.array(3.0),
    np.zeros(19, dtype=np.uint8), np.zeros((4, 4)), -np.eye(4), np.zeros(7), np.zeros((2, 7)),
]  # fmt: skip


class TooLong(Exception):
    pass


def interrupt(_signal, _frame):
    raise TooLong()


def call(function, arguments, keywords):
    signal.signal(signal.SIGALRM, interrupt)
    signal.setitimer(signal.ITIMER_REAL, LONGEST_CALL)
    begin = time.monotonic()
    try:
        return function(*arguments, **keywords)
    except TooLong:
        return None
    except Exception as error:  # an answer in words; what is none ends the process
        str(error)
        return None
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0)
        took = time.monotonic() - begin
        if took > LONGEST_CALL + LONGEST_END:
            print(f"a call of {took:.1f} s", flush=True)
            os._exit(3)


def main(seed, seconds):
    chance = random.Random(seed)
    warnings.simplefilter("ignore")
    functions = list(stubbed_functions())
    good = good_values()
    blanks = list(uninitialised())
    values = ODD + good + blanks
    made = []  # answers of earlier calls, to go on with
    end = time.monotonic() + seconds
    calls = 0
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        while time.monotonic() < end:
            owner, name, arguments, settings = chance.choice(functions)
            pool = values + made
            if owner is None:
                target = getattr(handway, name)
            else:
                cls = getattr(handway, owner)
                fitting = [v for v in good + made if isinstance(v, cls)]
                if fitting and chance.random() < 0.8:
                    instance = chance.choice(fitting)
                else:
                    instance = chance.choice(pool)
                if arguments is None or isinstance(getattr(cls, name, None), property):
                    print(f"{owner}.{name} of {type(instance).__name__}", file=log)
                    descriptor = vars(cls).get(name)
                    if isinstance(descriptor, property):
                        call(descriptor.fget, [instance], {})
                    calls += 1
                    continue
                unbound = getattr(cls, name)
                target = lambda *a, f=unbound, i=instance, **k: f(i, *a, **k)
            count = chance.randint(0, len(arguments) if arguments else 2)
            positional = [chance.choice(pool) for _ in range(count)]
            keywords = {
                argument: chance.choice(pool)
                for argument in (arguments or [])[count:] + settings
                if chance.random() < 0.3
            }
            if name == "plan":
                keywords["time_limit"] = 0.2
            log.seek(0)
            log.truncate()
            try:
                print(f"{owner}.{name}({positional!r}, {keywords!r})"[:2000], file=log, flush=True)
            except Exception:
                print(f"{owner}.{name}(…)", file=log, flush=True)
            answer = call(target, positional, keywords)
            calls += 1
            if answer is not None and len(made) < 60:
                made.append(answer)
            elif answer is not None:
                made[chance.randrange(len(made))] = answer
        os.chdir("/")
    print(f"{calls} calls", flush=True)


if __name__ == "__main__":
    log = open(sys.argv[3], "w", errors="replace") if len(sys.argv) > 3 else open(os.devnull, "w")
    main(int(sys.argv[1]), float(sys.argv[2]))
