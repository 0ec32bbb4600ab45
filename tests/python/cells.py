"""Where the project's files are, and the scenes that tests share."""

import functools
import pathlib

import handway

ROOT = pathlib.Path(__file__).resolve().parents[2]


@functools.cache
def can_on_table():
    return handway.load_scene(ROOT / "scenes" / "can_on_table.yaml")
