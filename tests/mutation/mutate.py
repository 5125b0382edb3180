#!/usr/bin/env python3
"""Puts small faults into src, one at a time, and tells which of them no test notices.

    tests/mutation/mutate.py --seed 7 --count 100 --minutes 40
    tests/mutation/mutate.py --only 'src/sim/*' --list      # what could be done there, nothing is built
    tests/mutation/mutate.py --again build-mutation/report.jsonl   # those that survived, behind new tests

Run by hand, never by CI: a fault costs half a minute. All work is done in a worktree of its own, build-mutation/tree,
at the commit that is checked out (what is not committed is not seen), so that the checkout is never left broken; a
build there is cheap where ccache knows the units. Every fault is one changed line, drawn by the seed: first a kind of
fault, then a place. What the compiler refuses is drawn again. Of the rooms' test programs those that can notice a fault
run, the nearest first, until one fails. What survives is printed with its patch and kept in report.jsonl: each is a
missing test, or a line that makes no difference and should not be there.

Exit code: 0, or 1 where a fault survived in spite of --strict.
"""
import argparse, fnmatch, json, os, random, re, signal, subprocess, sys, time
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
WORK = ROOT / "build-mutation"
TREE = WORK / "tree"
REPORT = WORK / "report.jsonl"
LAUNCHER = WORK / "compile"

# Which programs can notice a fault in a room, the nearest first.
CONCERNED = {
    "core": ["core_test", "sim_test", "app_test", "files_test"],
    "expr": ["expr_test", "sim_test", "scene_test", "app_test"],
    "mesh": ["mesh_test", "model_test", "draw_test", "app_test"],
    "integrate": ["integrate_test", "sim_test", "app_test"],
    "picture": ["picture_test", "draw_test", "render_test", "app_test", "pictures_test"],
    "encode": ["encode_test", "app_test", "files_test"],
    "model": ["model_test", "dynamics_test", "sim_test", "scene_test", "app_test"],
    "render": ["render_test", "draw_test", "app_test", "pictures_test"],
    "dynamics": ["dynamics_test", "sim_test", "peers_test", "app_test"],
    "sim": ["sim_test", "scene_test", "draw_test", "app_test"],
    "scene": ["scene_test", "draw_test", "app_test"],
    "draw": ["draw_test", "app_test", "pictures_test"],
    "app": ["app_test", "files_test", "pictures_test"],
}
# Tests that take long and notice what others notice, too.
TOO_SLOW = ["ChooseBattery.*", "HostileMesh.NodesThatMultiply*", "HostileMesh.MoreTriangles*", "Memory.*", "InterruptDeathTest.*"]
MOST_READERS = 3  # of a header that is changed: more would compile half of the tree

# Kinds of faults: what is looked for in a line without comments, and what stands there instead. {0}: what was found.
SWAPS = {
    "comparison": [(" < ", " <= "), (" <= ", " < "), (" > ", " >= "), (" >= ", " > "), (" == ", " != "), (" != ", " == ")],
    "sign": [(" + ", " - "), (" - ", " + "), (" += ", " -= "), (" -= ", " += "), ("return -", "return "), ("= -", "= ")],
    "factor": [(" * ", " / "), (" / ", " * "), (" *= ", " /= ")],
    "logic": [(" && ", " || "), (" || ", " && "), ("if (!", "if ("), ("return !", "return ")],
    "bound": [("std::min(", "std::max("), ("std::max(", "std::min("), ("= 0; ", "= 1; "), ("= 1; ", "= 0; ")],
    "index": [(" + 1]", "]"), (" - 1]", "]"), ("[0]", "[1]"), ("[1]", "[0]"), (".front()", ".back()"), (".back()", ".front()")],
    "constant": [("true", "false"), ("false", "true")],
    "function": [("sine(", "cosine("), ("cosine(", "sine("), ("floor(", "ceil(")],
    "exit code": [("ExitCode::usage", "ExitCode::bad_input"), ("ExitCode::bad_input", "ExitCode::usage"),
                  ("ExitCode::file", "ExitCode::limit"), ("ExitCode::limit", "ExitCode::file"),
                  ("ExitCode::numerical", "ExitCode::bad_input"), ("ExitCode::no_renderer", "ExitCode::file")],
}
NUMBER = re.compile(r"(?<![\w.\"<])(\d+\.\d+(?:e-?\d+)?|\d+e-?\d+|[2-9]|[1-9]\d+)(?![\w.\">])")
ARGUMENTS = re.compile(r"(?<=[\w>])\(([a-z_]\w*), ([a-z_]\w*)(?=[,)])")
STATEMENT = re.compile(r"^\s+(?!return|if|for|while|else|case|break|throw|using|const|auto|static|std::\w+[<\w])"
                       r"[\w.\[\]>()-]+(?:\(.*\)|(?: [-+*/|]?= ).*);$")


def other_number(text):
    if re.fullmatch(r"\d+", text):
        return str(int(text) + 1)
    return repr(float(text) * 1.25)


def without_comment(line):
    """The line's code, strings blanked, of the same length up to a comment."""
    line = re.sub(r'"(?:[^"\\]|\\.)*"', lambda m: '"' + " " * (len(m.group()) - 2) + '"', line)
    return line.split("//")[0]


def faults_in(path):
    """All faults that could be put into a file: (kind, line from 0, new line)."""
    lines = (TREE / path).read_text().split("\n")
    for number, line in enumerate(lines):
        code = without_comment(line)
        if not code.startswith(" ") and "constexpr" not in code:
            continue  # declarations, includes, closing brackets
        if re.search(r"static_assert|template|reserve\(|assert\(", code):
            continue

        def changed(at, length, new):
            return line[:at] + new + line[at + length:]

        for kind, swaps in SWAPS.items():
            if kind == "sign" and ('"' in code or "text" in code or "name" in code):
                continue  # words are joined by + and have no other sign
            for old, new in swaps:
                at = code.find(old)
                while at >= 0:
                    yield kind, number, changed(at, len(old), new)
                    at = code.find(old, at + 1)
        for match in NUMBER.finditer(code):
            yield "constant", number, changed(match.start(), len(match.group()), other_number(match.group()))
        for match in ARGUMENTS.finditer(code):
            if match.group(1) != match.group(2):
                yield "arguments", number, changed(match.start(), len(match.group()), f"({match.group(2)}, {match.group(1)}")
        if STATEMENT.match(code.rstrip()):
            yield "removed", number, re.match(r"\s*", line).group() + ";"


def files_to_change(only):
    headers_read = subprocess.run(["grep", "-rhoE", '#include "[^"]+"', "src"], cwd=TREE, capture_output=True, text=True).stdout
    readers = {}
    for name in re.findall(r'"([^"]+)"', headers_read):
        readers[name] = readers.get(name, 0) + 1
    for path in sorted((TREE / "src").rglob("*.[ch]pp")):
        name = str(path.relative_to(TREE))
        if not any(fnmatch.fnmatch(name, pattern) for pattern in only) or name.split("/")[1] not in CONCERNED:
            continue
        if path.suffix == ".cpp" or readers.get(name[4:], 0) <= MOST_READERS:
            yield name


def draw_faults(seed, only):
    """Without end but for the source's: kinds in turn by lot, places by lot, no line twice."""
    kinds = {}
    for path in files_to_change(only):
        for kind, line, new in faults_in(path):
            kinds.setdefault(kind, []).append((path, line, new))
    lot = random.Random(seed)
    for places in kinds.values():
        lot.shuffle(places)
    names, seen = sorted(kinds), set()
    while any(kinds.values()):
        kind = lot.choice([name for name in names if kinds[name]])
        path, line, new = kinds[kind].pop()
        if (path, line) not in seen:
            seen.add((path, line))
            old = (TREE / path).read_text().split("\n")[line]
            yield {"kind": kind, "file": path, "line": line + 1, "old": old, "new": new}


def survivors_of(report):
    for text in Path(report).read_text().splitlines():
        fault = json.loads(text)
        if fault["verdict"] != "survived":
            continue
        lines = (TREE / fault["file"]).read_text().split("\n") if (TREE / fault["file"]).exists() else []
        places = [i for i, line in enumerate(lines) if line == fault["old"]]
        if not places:
            print(f"gone: {fault['file']}: {fault['old'].strip()}")
            continue
        fault["line"] = min(places, key=lambda i: abs(i + 1 - fault["line"])) + 1
        yield fault


def run(command, timeout=None, **more):
    """The exit code; None where it took too long. What is said goes to a file."""
    with open(WORK / "last.log", "w") as log:
        process = subprocess.Popen(command, cwd=TREE, stdout=log, stderr=subprocess.STDOUT, start_new_session=True, **more)
        try:
            return process.wait(timeout)
        except subprocess.TimeoutExpired:
            return None
        finally:  # also where we are interrupted
            if process.poll() is None:
                os.killpg(process.pid, signal.SIGKILL)
                process.wait()


def build(target, jobs, has_fault=False):
    environment = {**os.environ, "MUTATION": "1"} if has_fault else os.environ
    return run(["ninja", "-C", "build", f"-j{jobs}", target], env=environment) == 0


def prepare():
    WORK.mkdir(exist_ok=True)
    head = subprocess.run(["git", "rev-parse", "HEAD"], cwd=ROOT, capture_output=True, text=True, check=True).stdout.strip()
    if not TREE.exists():
        subprocess.run(["git", "worktree", "add", "--detach", "--quiet", str(TREE), head], cwd=ROOT, check=True)
    subprocess.run(["git", "checkout", "--quiet", "--force", "--detach", head], cwd=TREE, check=True)
    # Units with a fault are compiled once and never again: with less optimisation, and not kept by ccache.
    LAUNCHER.write_text("#!/bin/sh\n[ -n \"$MUTATION\" ] || exec ccache \"$@\"\n"
                        "for word; do shift; [ \"$word\" = -O3 ] && word=-O1; set -- \"$@\" \"$word\"; done\nexec \"$@\"\n")
    LAUNCHER.chmod(0o755)
    if run(["cmake", "-S", ".", "-B", "build", "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release", "-DBUILD_TESTING=ON",
            f"-DCMAKE_CXX_COMPILER_LAUNCHER={LAUNCHER}"]) != 0:
        sys.exit(f"could not configure: see {WORK / 'last.log'}")


class Programs:
    """Test programs, each seen to pass before it judges."""

    def __init__(self, jobs, nearest):
        self.jobs, self.nearest, self.seconds = jobs, nearest, {}

    def command(self, program):
        return [f"build/bin/{program}", "--gtest_fail_fast", "--gtest_brief=1", "--gtest_filter=-" + ":".join(TOO_SLOW)]

    def know(self, program):
        if program in self.seconds:
            return
        if not build(program, self.jobs):
            sys.exit(f"{program} is not built even without a fault: see {WORK / 'last.log'}")
        start = time.monotonic()
        if run(self.command(program), 1200) != 0:
            sys.exit(f"{program} fails even without a fault: see {WORK / 'last.log'}")
        self.seconds[program] = time.monotonic() - start

    def judge(self, fault):
        """The verdict on a fault, which is in the tree only as long as it is judged."""
        programs = CONCERNED[fault["file"].split("/")[1]]
        for program in programs[:1] if self.nearest else programs:
            self.know(program)
            path = TREE / fault["file"]
            whole = path.read_text()
            lines = whole.split("\n")
            lines[fault["line"] - 1] = fault["new"]
            path.write_text("\n".join(lines))
            try:
                if not build(program, self.jobs, has_fault=True):
                    return "refused"
                code = run(self.command(program), 60 + 5 * self.seconds[program])
            finally:
                path.write_text(whole)
            if code != 0:
                text = (WORK / "last.log").read_text(errors="replace")
                failed = re.search(r"\[  FAILED  \] (\S+?)[, ]", text)
                by = failed.group(1) if failed else "no end" if code is None else "crash"
                return f"noticed by {program} {by}"
        return "survived"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--count", type=int, default=100)
    parser.add_argument("--minutes", type=float, default=1e9, help="no fault is begun behind them")
    parser.add_argument("--only", nargs="+", default=["src/*"], help="patterns of files")
    parser.add_argument("--nearest", action="store_true", help="the room's own test program judges alone: a quick look")
    parser.add_argument("--again", metavar="REPORT", help="the survivors of a report instead of new faults")
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    parser.add_argument("--list", action="store_true", help="print the faults drawn, and do nothing")
    parser.add_argument("--strict", action="store_true", help="exit 1 where one survives")
    options = parser.parse_args()
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(143))
    prepare()
    faults = list(survivors_of(options.again)) if options.again else draw_faults(options.seed, options.only)
    programs, counted, survived, end = Programs(options.jobs, options.nearest), 0, [], time.monotonic() + 60 * options.minutes
    report = None if options.list else open(REPORT, "w")
    for fault in faults:
        if counted >= options.count or time.monotonic() > end:
            break
        patch = f"{fault['file']}:{fault['line']} ({fault['kind']})\n  - {fault['old'].strip()}\n  + {fault['new'].strip()}"
        if options.list:
            counted += 1
            print(patch)
            continue
        fault["verdict"] = programs.judge(fault)
        if fault["verdict"] == "refused":
            continue
        counted += 1
        survived += [patch] if fault["verdict"] == "survived" else []
        report.write(json.dumps(fault) + "\n")
        report.flush()
        print(f"{counted:3} {fault['verdict']}: {patch}", flush=True)
    if not options.list and counted:
        print(f"\nseed {options.seed}: {counted - len(survived)} of {counted} noticed. Survived:\n" + "\n".join(survived))
    return 1 if options.strict and survived else 0


if __name__ == "__main__":
    sys.exit(main())
