"""The code of docs/python.md, run from top to bottom in one session as a reader would."""

import os
import re
import shutil
import tempfile
import unittest

from cells import ROOT


def code_blocks(page):
    return re.findall(r"^```python\n(.*?)^```", page, re.DOTALL | re.MULTILINE)


class Manual(unittest.TestCase):
    def test_runs_as_printed(self):
        page = ROOT / "docs" / "python.md"
        blocks = code_blocks(page.read_text())
        self.assertGreater(len(blocks), 5)
        before = os.getcwd()
        with tempfile.TemporaryDirectory() as folder:
            shutil.copytree(ROOT / "scenes", os.path.join(folder, "scenes"))
            os.symlink(ROOT / "resources", os.path.join(folder, "resources"))
            os.chdir(folder)
            try:
                session = {"__name__": "__main__"}
                for number, block in enumerate(blocks, 1):
                    exec(compile(block, f"docs/python.md, block {number}", "exec"), session)
            finally:
                os.chdir(before)


if __name__ == "__main__":
    unittest.main()
