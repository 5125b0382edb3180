"""What other comparisons of pictures say of pairs of them: each once over all pairs, timed.

pytest-mpl's (matplotlib's compare_images, tolerance 2) and ImageMagick's `compare` come from Debian (packages.txt, [bench]);
pixelmatch and odiff from npm, where a folder has them: npm install --prefix FOLDER pixelmatch pngjs odiff-bin
"""
import json, os, resource, subprocess, time
from pathlib import Path


class NotHere(Exception):
    pass


def each(command, equal, differs):
    """A process for each pair; `command` makes its words of the two paths."""
    def judge(pairs):
        verdicts = []
        for before, after in pairs:
            try:
                run = subprocess.run(command(str(before), str(after)), capture_output=True, text=True)
            except FileNotFoundError as error:
                raise NotHere(error.filename)
            if run.returncode not in (equal, differs): raise NotHere("exit %d: %s" % (run.returncode, run.stderr.strip()))
            verdicts.append(run.returncode == differs)
        return verdicts
    return judge


def at_once(command, environment=None):
    """One process for all pairs, which come as JSON on standard input; it answers with a list of true and false."""
    def judge(pairs):
        try:
            run = subprocess.run(command, input=json.dumps([[str(a), str(b)] for a, b in pairs]), capture_output=True, text=True,
                                 env=dict(os.environ, **(environment or {})))
        except FileNotFoundError as error:
            raise NotHere(error.filename)
        if run.returncode: raise NotHere(run.stderr.strip().splitlines()[-1])
        return json.loads(run.stdout)
    return judge


MATPLOTLIB = """
import json, sys
from matplotlib.testing.compare import compare_images
print(json.dumps([compare_images(a, b, tol=2) is not None for a, b in json.load(sys.stdin)]))
"""

PIXELMATCH = """
const [fs, path, url] = [require('fs'), require('path'), require('url')];
const {PNG} = require(path.join(process.env.PEERS, 'pngjs'));
import(url.pathToFileURL(path.join(process.env.PEERS, 'pixelmatch/index.js'))).then(({default: pixelmatch}) => {
  const read = name => PNG.sync.read(fs.readFileSync(name));
  console.log(JSON.stringify(JSON.parse(fs.readFileSync(0)).map(([before, after]) => {
    const a = read(before), b = read(after);
    return a.width != b.width || a.height != b.height || pixelmatch(a.data, b.data, null, a.width, a.height) > 0;
  })));
});
"""


def peers(program, npm):
    """Name and comparison each; a comparison takes pairs of paths and says for each whether it differs."""
    modules = str(Path(npm or ".").resolve() / "node_modules")
    magick = lambda *more: each(lambda a, b: ["compare", "-metric", "AE", *more, a, b, "null:"], 0, 1)
    found = [("chainreel compare", each(lambda a, b: [program, "compare", a, b, "--quiet"], 0, 1)),
             ("pytest-mpl, RMS 2", at_once(["/usr/bin/python3", "-c", MATPLOTLIB])),
             ("ImageMagick AE", magick()),
             ("ImageMagick AE -fuzz 2%", magick("-fuzz", "2%"))]
    if npm:
        # The program itself: odiff-bin's starts it from node.
        odiff = next(Path(modules).glob("@odiff/*/odiff"), Path("odiff"))
        found += [("pixelmatch", at_once(["node", "-e", PIXELMATCH], {"PEERS": modules})),
                  ("odiff", each(lambda a, b: [str(odiff), a, b], 0, 22))]
    return found


def child_seconds():
    spent = resource.getrusage(resource.RUSAGE_CHILDREN)
    return spent.ru_utime + spent.ru_stime


def ask(judge, pairs):
    """Verdicts, seconds by the clock and seconds of processor time."""
    clock, spent = time.time(), child_seconds()
    verdicts = judge(pairs)
    return verdicts, time.time() - clock, child_seconds() - spent
