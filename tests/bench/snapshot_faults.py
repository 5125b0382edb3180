#!/usr/bin/env python3
"""Small faults against suites of pictures: which of them `verify` finds, and whether its words name the cause.

    tests/bench/snapshot_faults.py --program build/chainreel --count 200 --seed 7
    tests/bench/snapshot_faults.py --peers            # the same pictures given to other comparisons, too
    tests/bench/snapshot_faults.py --peers --npm FOLDER   # .. and to those of npm (see picture_peers.py)

Three suites are made of the project's models and scenes and accepted; then faults are put in one at a time, drawn by the
seed: into a model (a mass by 1 %, an origin by a pixel or 1e-3 rad, a colour by 4/255, a triangle of a mesh, a limit, a
name ..), into a scene (a torque, a method, a step, a start, a layer, a theme ..), or into what a renderer made of it
(pixels of a baseline, a glyph, another font, a shift by a pixel). A fault counts as found where verify ends with 1, and
as explained where a sentence about a picture names the link, joint, key or text that it was put into. Run by hand.
"""
import argparse, hashlib, json, os, random, re, shutil, struct, subprocess, sys, tempfile, time, zlib
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
from picture_peers import NotHere as PeerNotHere, ask, child_seconds, peers

ROOT = Path(__file__).resolve().parents[2]

# --- PNG, as much of it as our own pictures need


def read_png(path):
    data = path.read_bytes()
    chunks, at = [], 8
    while at < len(data):
        size = struct.unpack(">I", data[at:at + 4])[0]
        chunks.append((data[at + 4:at + 8], data[at + 8:at + 8 + size]))
        at += 12 + size
    width, height, _, kind = struct.unpack(">IIBB", chunks[0][1][:10])
    step = {2: 3, 6: 4}[kind]
    raw = zlib.decompress(b"".join(body for name, body in chunks if name == b"IDAT"))
    rows, before = [], bytearray(width * step)
    for y in range(height):
        line = raw[y * (width * step + 1):(y + 1) * (width * step + 1)]
        method, row = line[0], bytearray(line[1:])
        for i in range(len(row)):
            a = row[i - step] if i >= step else 0
            b = before[i]
            c = before[i - step] if i >= step else 0
            if method == 1: row[i] = (row[i] + a) & 255
            elif method == 2: row[i] = (row[i] + b) & 255
            elif method == 3: row[i] = (row[i] + (a + b) // 2) & 255
            elif method == 4:
                p = a + b - c
                pa, pb, pc = abs(p - a), abs(p - b), abs(p - c)
                row[i] = (row[i] + (a if pa <= pb and pa <= pc else b if pb <= pc else c)) & 255
        rows.append(row)
        before = row
    return chunks, rows, step


def write_png(path, chunks, rows):
    body = zlib.compress(b"".join(b"\0" + bytes(row) for row in rows), 6)
    out, done = [b"\x89PNG\r\n\x1a\n"], False
    for name, data in chunks:
        if name == b"IDAT":
            if done: continue
            data, done = body, True
        out.append(struct.pack(">I", len(data)) + name + data + struct.pack(">I", zlib.crc32(name + data)))
    path.write_bytes(b"".join(out))


def as_if_rendered(folder, name, change):
    """The baseline as another renderer would have left it: its hash is right, its pixels are not."""
    path = folder / (name + ".png")
    chunks, rows, step = read_png(path)
    change(rows, step)
    write_png(path, chunks, rows)
    facts = json.loads((folder / (name + ".json")).read_text())
    facts["png_sha256"] = hashlib.sha256(path.read_bytes()).hexdigest()
    (folder / (name + ".json")).write_text(json.dumps(facts))


# --- suites

CUBE = [((0, 0, 0), (1, 0, 0), (1, 1, 0)), ((0, 0, 0), (1, 1, 0), (0, 1, 0)), ((0, 0, 1), (1, 1, 1), (1, 0, 1)),
        ((0, 0, 1), (0, 1, 1), (1, 1, 1)), ((0, 0, 0), (1, 0, 1), (1, 0, 0)), ((0, 0, 0), (0, 0, 1), (1, 0, 1)),
        ((0, 1, 0), (1, 1, 0), (1, 1, 1)), ((0, 1, 0), (1, 1, 1), (0, 1, 1)), ((0, 0, 0), (0, 1, 0), (0, 1, 1)),
        ((0, 0, 0), (0, 1, 1), (0, 0, 1)), ((1, 0, 0), (1, 1, 1), (1, 1, 0)), ((1, 0, 0), (1, 0, 1), (1, 1, 1))]


def write_stl(path, triangles):
    lines = ["solid part"]
    for t in triangles:
        lines += ["facet normal 0 0 0", "outer loop"] + ["vertex %g %g %g" % tuple(0.2 * x for x in v) for v in t] + ["endloop", "endfacet"]
    path.write_text("\n".join(lines + ["endsolid part"]) + "\n")


def make_suites(folder):
    (folder / "models").mkdir(parents=True)
    for model in ("rr.urdf", "rrr.urdf", "arm.urdf"):
        shutil.copy(ROOT / "models" / model, folder / "models" / model)
    arm = (folder / "models/arm.urdf").read_text()
    write_stl(folder / "models/part.stl", CUBE)
    # A mesh on the arm's first link that has a shape.
    arm = arm.replace("<visual><origin xyz=\"0 0 0.21\"/><geometry><cylinder radius=\"0.048\" length=\"0.36\"/></geometry>",
                      "<visual><origin xyz=\"-0.1 -0.1 0.05\"/><geometry><mesh filename=\"part.stl\"/></geometry>")
    (folder / "models/arm.urdf").write_text(arm)
    (folder / "poses.yaml").write_text("model: models/rrr.urdf\nsize: 640x360\n"
                                       "poses: {home: [0, 0, 0], up: [90deg, 0, 0], bent: [30deg, 60deg, -45deg]}\n")
    (folder / "arm.yaml").write_text("model: models/arm.urdf\nsize: 480x360\nposes: {home: [0, 0, 0, 0, 0, 0], reach: [20deg, 40deg, 50deg, 0, 30deg, 0]}\n")
    scene = (ROOT / "assets/scenes/rr_torque.yaml").read_text().replace("../../models", "models").replace("duration: 10", "duration: 2")
    (folder / "swing.yaml").write_text(scene + "draw: [+torque, +velocity]\n")
    (folder / "motion.yaml").write_text("scene: swing.yaml\nsize: 640x360\nat: [0, 0.7s, 1.5s]\n")
    return ["poses.yaml", "arm.yaml", "motion.yaml"]


# --- faults: each returns the suite concerned and words of which one must be named


class NotHere(Exception):
    pass


def edit(path, pattern, make, lot, scope=None):
    """Replaces one match, drawn by lot; returns the name of the link or joint around it."""
    text = path.read_text()
    matches = [m for m in re.finditer(pattern, text) if not scope or scope(text, m)]
    if not matches: raise NotHere
    m = lot.choice(matches)
    path.write_text(text[:m.start()] + make(m) + text[m.end():])
    # <material> within a <visual> only names one.
    owners = [o for o in re.finditer(r"<(link|joint|material) name=\"([^\"]+)\"", text[:m.start()])
              if o.group(1) != "material" or not scope]
    return owners[-1].group(2) if owners else ""


def number(text, scale=1.0, add=0.0):
    return repr(float(text) * scale + add)


def xyz(m, lot, size, index=None):
    values = [float(v) for v in m.group(2).split()]
    k = lot.randrange(3) if index is None else index
    values[k] += size
    return m.group(1) + " ".join(repr(v) for v in values) + m.group(3)


MODELS = [("models/rrr.urdf", "poses.yaml"), ("models/arm.urdf", "arm.yaml"), ("models/rr.urdf", "motion.yaml")]
IN_LINK = lambda text, m: text.rfind("<link", 0, m.start()) > text.rfind("</link>", 0, m.start())
IN_JOINT = lambda text, m: text.rfind("<joint", 0, m.start()) > text.rfind("</joint>", 0, m.start())
IN_VISUAL = lambda text, m: text.rfind("<visual", 0, m.start()) > text.rfind("</visual>", 0, m.start())
IN_INERTIAL = lambda text, m: text.rfind("<inertial", 0, m.start()) > text.rfind("</inertial>", 0, m.start())


def model_fault(pattern, make, scope, only=None):
    def put(folder, lot):
        model, suite = lot.choice([x for x in MODELS if not only or x[0] in only])
        return suite, [edit(folder / model, pattern, lambda m: make(m, lot), lot, scope)]
    return put


def gone_triangle(folder, lot):
    triangles = list(CUBE)
    del triangles[lot.randrange(len(triangles))]
    write_stl(folder / "models/part.stl", triangles)
    return "arm.yaml", ["part.stl"]


def renamed(what):
    def put(folder, lot):
        model, suite = lot.choice(MODELS[:2])
        path = folder / model
        text = path.read_text()
        names = re.findall(r"<%s name=\"([^\"]+)\"" % what, text)
        name = lot.choice(names)
        path.write_text(re.sub(r"\"%s\"" % re.escape(name), "\"%s_b\"" % name, text))
        return suite, [name]
    return put


def scene_fault(pattern, replacement, words):
    def put(folder, lot):
        path = folder / "swing.yaml"
        text = path.read_text()
        if not re.search(pattern, text): raise NotHere
        path.write_text(re.sub(pattern, replacement, text, count=1))
        return "motion.yaml", words
    return put


def picture_fault(kind):
    def put(folder, lot):
        suite, names = lot.choice([("poses.yaml", ["home", "up", "bent"]), ("motion.yaml", [])])
        base = folder / (suite[:-5] + ".baselines")
        names = names or sorted(p.stem for p in base.glob("*.png"))
        name = lot.choice(names)

        def change(rows, step):
            height, width = len(rows), len(rows[0]) // step
            if kind == "colour":  # 50 pixels of 4/255
                y0, x0 = lot.randrange(height - 5), lot.randrange(width - 10)
                for y in range(y0, y0 + 5):
                    for x in range(x0, x0 + 10):
                        i = x * step + lot.randrange(3)
                        rows[y][i] = rows[y][i] - 4 if rows[y][i] > 127 else rows[y][i] + 4
            elif kind == "glyph":  # a letter of the words below the scene: dark pixels in the lowest tenth
                for y in range(int(height * 0.88), height):
                    dark = [x for x in range(width) if rows[y][x * step] < 140]
                    if dark:
                        at = dark[0]
                        for yy in range(max(0, y - 14), min(height, y + 14)):
                            for x in range(max(0, at - 8), min(width, at + 8)):
                                rows[yy][x * step:x * step + 3] = rows[0][0:3]
                        return
                raise NotHere
            elif kind == "shift":  # by one pixel to the right
                for row in rows:
                    row[step:] = row[:-step]
        as_if_rendered(base, name, change)
        return suite, ["there:"]
    return put


def old_font(folder, lot):
    base = folder / "motion.baselines"
    for path in base.glob("*.json"):
        facts = json.loads(path.read_text())
        fonts = facts.get("page", {}).get("fonts", {})
        for font in fonts: fonts[font] = "0" * 64
        if fonts: path.write_text(json.dumps(facts))
    name = lot.choice(sorted(p.stem for p in base.glob("*.png")))

    def change(rows, step):
        for row in rows[-30:]: row[step * 2:] = row[:-step * 2]
    as_if_rendered(base, name, change)
    return "motion.yaml", ["font"]


def frame_dropped(folder, lot):
    path = folder / "motion.yaml"
    path.write_text(path.read_text().replace("0.7s", lot.choice(["0.6833333s", "0.7166667s"])))
    return "motion.yaml", ["0.7s"]


XYZ = r"(xyz=\")([-0-9.e ]+)(\")"
FAULTS = {
    "mass by 1 %": model_fault(r"<mass value=\"([0-9.e+-]+)\"", lambda m, lot: '<mass value="%s"' % number(m.group(1), 1.01), IN_LINK),
    "inertia by 1 %": model_fault(r"(i(?:xx|yy|zz)=\")([0-9.e-]*[1-9][0-9.e-]*)(\")", lambda m, lot: m.group(1) + number(m.group(2), 1.01) + m.group(3), IN_LINK, ["models/arm.urdf"]),
    "link moved by a pixel": model_fault(XYZ, lambda m, lot: xyz(m, lot, 0.008, 0), IN_JOINT),
    "joint off by 1e-3 rad": model_fault(r"<axis xyz=\"([-0-9. ]+)\"/>", lambda m, lot: '<axis xyz="%s"/>' % " ".join(repr(float(v) + (1e-3 if float(v) == 0 and i == 0 else 0)) for i, v in enumerate(m.group(1).split())), IN_JOINT, ["models/arm.urdf"]),
    "centre of mass moved": model_fault(XYZ, lambda m, lot: xyz(m, lot, 0.001), IN_INERTIAL),
    "colour by 4/255": model_fault(r"(rgba=\")([0-9. ]+)(\")", lambda m, lot: m.group(1) + " ".join(repr(round(float(v) - 4 / 255 if float(v) > 0.5 else float(v) + 4 / 255, 4)) if i == 1 else v for i, v in enumerate(m.group(2).split())) + m.group(3), None, ["models/arm.urdf"]),
    "shape moved": model_fault(XYZ, lambda m, lot: xyz(m, lot, 0.01), IN_VISUAL, ["models/arm.urdf"]),
    "shape grown": model_fault(r"radius=\"([0-9.]+)\"", lambda m, lot: 'radius="%s"' % number(m.group(1), 1.05), IN_VISUAL, ["models/arm.urdf"]),
    "triangle gone": gone_triangle,
    "link renamed": renamed("link"),
    "joint renamed": renamed("joint"),
    "torque by 1 %": scene_fault(r"torque: \[1, 1\]", "torque: [1, 1.01]", ["torque"]),
    "torque's sign": scene_fault(r"torque: \[1, 1\]", "torque: [-1, 1]", ["torque"]),
    "method": scene_fault("semi_implicit_euler", "rk4", ["method"]),
    "step doubled": scene_fault("step: 0.001", "step: 0.002", ["step"]),
    "start by 1e-3 rad": scene_fault(r"q: \[0, 0\]", "q: [0.001, 0]", ["start"]),
    "start's rate": scene_fault(r"qd: \[0, 0\]", "qd: [0, 0.01]", ["start"]),
    "gravity by 0.1 %": scene_fault("-9.81", "-9.8", ["gravity"]),
    "layer gone": scene_fault(r"\+torque, \+velocity", "+torque", ["draw"]),
    "theme": scene_fault("duration: 2", "duration: 2\ntheme: dark", ["theme"]),
    "title": scene_fault("RR under", "RRR under", ["title"]),
    "50 pixels by 4/255": picture_fault("colour"),
    "a glyph missing": picture_fault("glyph"),
    "a picture moved by a pixel": picture_fault("shift"),
    "an old font": old_font,
    "a frame dropped": frame_dropped,
}


def verify(program, folder, suite, *more):
    run = subprocess.run([program, "verify", suite, "--json", *more], cwd=folder,
                         capture_output=True, text=True)
    try:
        return run.returncode, json.loads(run.stdout)
    except ValueError:
        return run.returncode, {"pictures": [], "error": run.stderr}


def pairs_of(folder, suite, into):
    """Copies of each picture's baseline and of what was drawn: where verify shows nothing, they were equal."""
    into.mkdir(parents=True)
    pairs = []
    for path in sorted((folder / (suite[:-5] + ".baselines")).glob("*.png")):
        shown = [folder / "shown" / ("%s.%s.png" % (path.stem, side)) for side in ("expected", "actual")]
        pair = [into / ("%s.%s.png" % (path.stem, side)) for side in ("before", "after")]
        for source, target in zip(shown if shown[1].exists() else [path, path], pair):
            shutil.copy(source if source.exists() else path, target)
        pairs.append(pair)
    return pairs


def ask_peers(program, npm, by_fault):
    """`by_fault` has the pairs of each fault; a fault is found where one of its pairs differs."""
    pairs = [pair for fault in by_fault for pair in fault]
    print("%d pairs of pictures:" % len(pairs))
    for name, judge in peers(program, npm):
        try:
            verdicts, clock, spent = ask(judge, pairs)
        except PeerNotHere as reason:
            print("%-26s not here: %s" % (name, reason))
            continue
        rest = iter(verdicts)
        found = sum(any([next(rest) for _ in fault]) for fault in by_fault)
        print("%-26s finds %3d of %d, %6.1f s, %6.1f s of processor" % (name, found, len(by_fault), clock, spent))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--program", default=str(ROOT / "build/chainreel"))
    parser.add_argument("--count", type=int, default=200)
    parser.add_argument("--seed", type=int, default=7)
    parser.add_argument("--peers", action="store_true", help="other comparisons over the same pictures")
    parser.add_argument("--npm", help="a folder whose node_modules has pixelmatch, pngjs and odiff-bin")
    options = parser.parse_args()
    program = os.path.abspath(options.program)
    lot = random.Random(options.seed)
    found = explained = pictures = 0
    clock = spent = 0.0
    missed, by_fault = [], []
    with tempfile.TemporaryDirectory() as work:
        sound = Path(work) / "sound"
        suites = make_suites(sound)
        for suite in suites:
            code, _ = verify(program, sound, suite, "--missing", "write")
            again, result = verify(program, sound, suite)
            if code or again: sys.exit("%s: cannot be accepted: %s" % (suite, result))
        tried = 0
        while tried < options.count:
            kind = lot.choice(sorted(FAULTS))
            folder = Path(work) / "faulty"
            shutil.rmtree(folder, ignore_errors=True)
            shutil.copytree(sound, folder)
            try:
                suite, words = FAULTS[kind](folder, lot)
            except NotHere:
                continue
            tried += 1
            begin, begin_spent = time.time(), child_seconds()
            code, result = verify(program, folder, suite, *(["-o", "shown"] if options.peers else []))
            clock, spent = clock + time.time() - begin, spent + child_seconds() - begin_spent
            pictures += len(result["pictures"])
            said = [w for p in result["pictures"] if not p["passed"] for w in p["words"]]
            named = any(word and word in sentence for word in words for sentence in said)
            found += code == 1
            explained += code == 1 and named
            if options.peers: by_fault.append(pairs_of(folder, suite, Path(work) / "pairs" / str(tried)))
            if code != 1 or not named: missed.append((kind, words, code, said[:4] or result.get("error", "")))
        for kind, words, code, said in missed: print("%-28s %s exit %d: %s" % (kind, words, code, said))
        print("%d faults, seed %d: %d found, %d explained" % (options.count, options.seed, found, explained))
        print("%-26s finds %3d of %d, %6.1f s, %6.1f s of processor, drawing %d pictures included" %
              ("chainreel verify", found, options.count, clock, spent, pictures))
        if options.peers: ask_peers(program, options.npm, by_fault)


if __name__ == "__main__":
    main()
