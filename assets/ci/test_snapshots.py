"""Each picture of a suite as a test: put this file beside snapshots.yaml and run `pytest`.

What failed is accepted by `chainreel verify snapshots.yaml --accept NAME`. The environment may name another suite (SUITE) and
where the program is (CHAINREEL).
"""

import json
import os
import pathlib
import subprocess

SUITE = os.environ.get("SUITE", str(pathlib.Path(__file__).with_name("snapshots.yaml")))
CHAINREEL = os.environ.get("CHAINREEL", "chainreel")


def verified_pictures():
    """What `verify` says of each picture, by its name; all are drawn by one process."""
    command = [CHAINREEL, "verify", SUITE, "--json", "--html", "out/report.html"]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    if done.returncode not in (0, 1):  # nothing was compared: the suite itself is wrong
        raise RuntimeError(done.stderr)
    return {picture["name"]: picture for picture in json.loads(done.stdout)["pictures"]}


def pytest_generate_tests(metafunc):
    if "picture" in metafunc.fixturenames:
        pictures = verified_pictures()
        metafunc.parametrize("picture", list(pictures.values()), ids=list(pictures))


def test_snapshot(picture):
    assert picture["passed"], "; ".join([picture["state"], *picture["words"]])
