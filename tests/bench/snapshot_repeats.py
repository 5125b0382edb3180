#!/usr/bin/env python3
"""False alarms: the same suites verified again and again where nothing has changed but what must not matter.

    tests/bench/snapshot_repeats.py --program build/chainreel --pictures 1000

    tests/bench/snapshot_repeats.py --pictures 0 --emulated 0 --peers --npm FOLDER

Baselines are made once; then thread counts, folder, home, language, time zone and, for some runs, the processor (QEMU, an
old one and a new one) change by lot. Each picture that is not `same` is a false alarm. With --peers the same pictures drawn on two emulated processors are given
to other comparisons (picture_peers.py). Run by hand.
"""
import argparse, json, os, random, shutil, subprocess, sys, tempfile
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
from picture_peers import NotHere, ask, peers
from snapshot_faults import make_suites

ROOT = Path(__file__).resolve().parents[2]
PROCESSORS = ["Nehalem", "max"]


def emulated(processor, command):
    return ["qemu-x86_64", "-cpu", processor] + command


def ask_peers(program, npm, sound, suites, work):
    """Alarms of other comparisons between pictures drawn on two processors."""
    drawn = []
    for processor in PROCESSORS:
        folder = Path(work) / processor
        shutil.copytree(sound, folder, ignore=shutil.ignore_patterns("*.baselines"))
        for suite in suites:
            subprocess.run(emulated(processor, [program, "verify", suite, "--missing", "write", "--quiet"]), cwd=folder,
                           check=True)
        drawn.append(sorted(folder.rglob("*.baselines/*.png")))
    pairs = list(zip(*drawn))
    print("%s: %d pairs of pictures, %d of the same bytes" %
          (" and ".join(PROCESSORS), len(pairs), sum(a.read_bytes() == b.read_bytes() for a, b in pairs)))
    for name, judge in peers(program, npm):
        try:
            print("%-26s %d false alarms" % (name, sum(ask(judge, pairs)[0])))
        except NotHere as reason:
            print("%-26s not here: %s" % (name, reason))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--program", default=str(ROOT / "build/chainreel"))
    parser.add_argument("--pictures", type=int, default=1000)
    parser.add_argument("--emulated", type=int, default=4, help="runs on emulated processors")
    parser.add_argument("--peers", action="store_true", help="other comparisons of pictures drawn on two processors")
    parser.add_argument("--npm", help="a folder whose node_modules has pixelmatch, pngjs and odiff-bin")
    parser.add_argument("--seed", type=int, default=7)
    options = parser.parse_args()
    program, lot = os.path.abspath(options.program), random.Random(options.seed)
    looked, alarms, emulations, states = 0, 0, 0, {}
    with tempfile.TemporaryDirectory() as work:
        sound = Path(work) / "sound"
        suites = make_suites(sound)
        for suite in suites:
            subprocess.run([program, "verify", suite, "--missing", "write", "--quiet"], cwd=sound, check=True)
        run = 0
        while looked < options.pictures or emulations < options.emulated:
            folder = Path(work) / ("place %d" % lot.randrange(3)) / "deeper"
            if not folder.exists(): shutil.copytree(sound, folder)
            suite = suites[run % len(suites)]
            command = [program, "verify", suite, "--json", "--jobs", str(lot.choice([1, 2, 4]))]
            if emulations < options.emulated:
                command = emulated(PROCESSORS[emulations % 2], command)
                emulations += 1
            environment = dict(os.environ, LP_NUM_THREADS=str(lot.randrange(5)), HOME=work, LC_ALL=lot.choice(["C", "C.UTF-8", "POSIX"]),
                               TZ=lot.choice(["UTC", "Asia/Tokyo"]))
            result = subprocess.run(command, cwd=folder, env=environment, capture_output=True, text=True)
            try:
                pictures = json.loads(result.stdout)["pictures"]
            except ValueError:
                sys.exit("no result: " + result.stderr)
            for picture in pictures:
                states[picture["state"]] = states.get(picture["state"], 0) + 1
                alarms += not picture["passed"]
                if not picture["passed"]: print(" ".join(command[:4]), picture["name"], picture["words"])
            looked += len(pictures)
            run += 1
        if options.peers: ask_peers(program, options.npm, sound, suites, work)
    print("%d pictures in %d runs, %d of them emulated: %d false alarms; %s" % (looked, run, emulations, alarms, states))


if __name__ == "__main__":
    main()
