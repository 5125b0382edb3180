"""What the tests of the module share."""

import json
import os
import subprocess
import tempfile
import unittest

PROGRAM = os.environ["CHAINREEL"]


def program(*words: str) -> str:
    """What the program prints; it must end well."""
    result = subprocess.run([PROGRAM, *words], capture_output=True, text=True, check=False)
    if result.returncode != 0:
        raise AssertionError(f"{words}: {result.stderr}")
    return result.stdout


def program_json(*words: str) -> dict:
    return json.loads(program(*words, "--json"))


class FolderTest(unittest.TestCase):
    """A test with a folder of its own."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name

    def path(self, name: str) -> str:
        return os.path.join(self.folder, name)

    def write(self, name: str, text: str) -> str:
        with open(self.path(name), "w", encoding="utf-8") as file:
            file.write(text)
        return self.path(name)
