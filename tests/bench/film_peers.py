#!/usr/bin/python3
"""What films cost: every scene beside its encoder alone, and a double pendulum beside what others make of one.

    film_peers.py CHAINREEL [MUJOCO_FILM] [--rounds 2] [--scenes FILE..]

The scenes of assets/scenes at 1920x1080 and 60 frames/s by `chainreel bench` go to results/films.csv. 10 s of a double pendulum
at 1280x720 and 60 frames/s as whole processes by turns go to results/film_peers.csv, the least of all rounds: the program
itself; matplotlib's FuncAnimation by its own writer for ffmpeg, of what our page shows (links, trail, energies with their axes
and legend, title, time) and of links and trail alone; a loop that draws each frame whole by pycairo, and MuJoCo's
way to record (mujoco_film: OSMesa, with and without shadows), both with raw frames to ffmpeg through a pipe. All encode by x264
veryfast, crf 18, 4:2:0. Those but the first of matplotlib show the two links, their joints and a trail, or a floor: no axes, no words.
"""
import argparse, csv, json, math, os, resource, subprocess, sys, tempfile, time
from pathlib import Path

HERE = Path(__file__).resolve().parent
SCENES = HERE.parent.parent / "assets" / "scenes"
WIDTH, HEIGHT, FPS, SECONDS = 1280, 720, 60, 10
X264 = ["-c:v", "libx264", "-preset", "veryfast", "-crf", "18", "-pix_fmt", "yuv420p"]


def encoder(pixels, target, more=()):
    return ["ffmpeg", "-v", "error", "-y", "-f", "rawvideo", "-pix_fmt", pixels, "-s", f"{WIDTH}x{HEIGHT}", "-r", str(FPS), "-i", "-",
            *more, *X264, target]


def motion():
    """Elbow, end [m], kinetic and potential energy [J] of two rods of 1 m, a point of 1 kg at the end of each, at every frame;
    four steps of RK4 a frame."""
    def rate(s):
        a, b, u, v = s
        c, d, g = math.cos(a - b), math.sin(a - b), 9.81
        p, q = -v * v * d - 2 * g * math.sin(a), u * u * d - g * math.sin(b)
        return u, v, (p - c * q) / (2 - c * c), (2 * q - c * p) / (2 - c * c)
    s, h = (math.pi / 2, math.pi / 2, 0.0, 0.0), 1 / FPS / 4
    move = lambda k, f: tuple(x + f * y for x, y in zip(s, k))
    for _ in range(FPS * SECONDS):
        a, b, u, v = s
        elbow = math.sin(a), -math.cos(a)
        yield (elbow, (elbow[0] + math.sin(b), elbow[1] - math.cos(b)), u * u + v * v / 2 + u * v * math.cos(a - b),
               -9.81 * (2 * math.cos(a) + math.cos(b)))
        for _ in range(4):
            k1 = rate(s); k2 = rate(move(k1, h / 2)); k3 = rate(move(k2, h / 2)); k4 = rate(move(k3, h))
            s = tuple(x + h / 6 * (p + 2 * q + 2 * r + t) for x, p, q, r, t in zip(s, k1, k2, k3, k4))


def film_of_matplotlib(target, whole_page):
    import matplotlib
    matplotlib.use("Agg")
    from matplotlib import animation, pyplot
    points = list(motion())
    figure = pyplot.figure(figsize=(WIDTH / 100, HEIGHT / 100), dpi=100)
    axes = figure.add_axes((0, 0.05, 0.6, 0.85) if whole_page else (0, 0, 1, 1), xlim=(-2.2, 2.2), ylim=(-2.2, 2.2), aspect="equal")
    axes.axis("off")
    trail, = axes.plot([], [], "-", color="tab:orange", lw=1.5)
    links, = axes.plot([], [], "o-", color="tab:blue", lw=5)
    page = page_of_matplotlib(figure, points) if whole_page else lambda k: ()

    def draw(k):
        elbow, end = points[k][:2]
        links.set_data([0, elbow[0], end[0]], [0, elbow[1], end[1]])
        past = [p[1] for p in points[:k + 1]]
        trail.set_data([p[0] for p in past], [p[1] for p in past])
        return trail, links, *page(k)
    writer = animation.FFMpegWriter(fps=FPS, codec="libx264", extra_args=X264[2:])
    animation.FuncAnimation(figure, draw, frames=len(points), blit=True).save(target, writer=writer)


def page_of_matplotlib(figure, points):
    """Title, time and torques, and energies whose future is faint; a function that moves them to a frame."""
    figure.text(0.03, 0.92, "RR without torques", fontsize=20, weight="bold")
    figure.text(0.97, 0.92, r"$\tau = (0, 0)$ N m", fontsize=16, ha="right")
    clock = figure.text(0.97, 0.03, "", fontsize=14, ha="right")
    plot = figure.add_axes((0.65, 0.14, 0.32, 0.7), xlim=(0, SECONDS), xlabel="t [s]", title="energy [J]")
    plot.grid(alpha=0.3)
    times = [k / FPS for k in range(len(points))]
    energies = {"kinetic": [p[2] for p in points], "potential": [p[3] for p in points], "total": [p[2] + p[3] for p in points]}
    past = []
    for name, values in energies.items():
        whole, = plot.plot(times, values, alpha=0.45)
        past.append((plot.plot([], [], color=whole.get_color(), lw=2, label=name)[0], values))
    plot.legend(loc="upper right")
    now = plot.axvline(0, color="black")

    def move(k):
        clock.set_text(f"t = {times[k]:.2f} s")
        now.set_xdata([times[k], times[k]])
        for line, values in past: line.set_data(times[:k + 1], values[:k + 1])
        return clock, now, *(line for line, _ in past)
    return move


def film_of_cairo(target):
    import cairo
    surface = cairo.ImageSurface(cairo.FORMAT_RGB24, WIDTH, HEIGHT)
    pen = cairo.Context(surface)
    pen.set_line_cap(cairo.LINE_CAP_ROUND)
    at = lambda p: (WIDTH / 2 + 160 * p[0], HEIGHT / 2 - 160 * p[1])
    trail = []
    with subprocess.Popen(encoder("bgr0", target), stdin=subprocess.PIPE) as film:
        for elbow, end, *_ in motion():
            trail.append(at(end))
            pen.set_source_rgb(1, 1, 1)
            pen.paint()
            pen.set_source_rgb(1, 0.5, 0)
            pen.set_line_width(2)
            pen.move_to(*trail[0])
            for point in trail[1:]: pen.line_to(*point)
            pen.stroke()
            pen.set_source_rgb(0.1, 0.4, 0.8)
            pen.set_line_width(10)
            pen.move_to(*at((0, 0)))
            pen.line_to(*at(elbow))
            pen.line_to(*at(end))
            pen.stroke()
            for joint in ((0, 0), elbow, end):
                pen.arc(*at(joint), 9, 0, 2 * math.pi)
                pen.fill()
            surface.flush()
            film.stdin.write(surface.get_data())
    if film.returncode: sys.exit("ffmpeg failed")


def film_of_mujoco(program, shadows, target):
    simulation = subprocess.Popen([program, str(WIDTH), str(HEIGHT), str(FPS), str(SECONDS), shadows], stdout=subprocess.PIPE,
                                  env=dict(os.environ, MUJOCO_GL="osmesa"))
    film = subprocess.run(encoder("rgb24", target, ["-vf", "vflip"]), stdin=simulation.stdout)
    simulation.stdout.close()
    if simulation.wait() or film.returncode: sys.exit("MuJoCo's film failed")


def timed(command):
    before, start = resource.getrusage(resource.RUSAGE_CHILDREN), time.monotonic()
    subprocess.run(command, check=True, stdout=subprocess.DEVNULL)
    wall, after = time.monotonic() - start, resource.getrusage(resource.RUSAGE_CHILDREN)
    return wall, after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def measure_peers(chainreel, mujoco, rounds):
    itself = [sys.executable, __file__, "--make"]
    with tempfile.TemporaryDirectory() as folder:
        film = lambda name: f"{folder}/{name}.mp4"
        commands = {"chainreel": [chainreel, "render", str(SCENES / "rr_free.yaml"), "-o", film("ours"), "--force", "--quiet",
                                  "--set", f"video.width={WIDTH}", "--set", f"video.height={HEIGHT}", "--set", f"video.fps={FPS}",
                                  "--set", f"duration={SECONDS}"],
                    "matplotlib, our page": [*itself, "page", film("matplotlib")],
                    "matplotlib, links alone": [*itself, "matplotlib", film("matplotlib")],
                    "pycairo, pipe to ffmpeg": [*itself, "cairo", film("cairo")]}
        if mujoco:
            for name, shadows in (("MuJoCo, shadows", "1"), ("MuJoCo, no shadows", "0")):
                commands[name] = [*itself, "mujoco", film("mujoco"), mujoco, shadows]
        times = {name: [] for name in commands}
        for _ in range(rounds):
            for name, command in commands.items(): times[name].append(timed(command))
    least = {name: [min(t) for t in zip(*taken)] for name, taken in times.items()}
    ours = least["chainreel"]
    with open(HERE / "results" / "film_peers.csv", "w", newline="") as file:
        rows = csv.writer(file, lineterminator="\n")
        rows.writerow(["film of 10 s, 1280x720, 60 fps", "wall s", "CPU s", "times ours, wall", "times ours, CPU"])
        for name, (wall, cpu) in least.items():
            rows.writerow([name, f"{wall:.2f}", f"{cpu:.2f}", f"{wall / ours[0]:.1f}", f"{cpu / ours[1]:.1f}"])
            print(f"{name:26} {wall:6.2f} s  CPU {cpu:6.2f} s  {wall / ours[0]:5.1f} times ours, CPU {cpu / ours[1]:5.1f}", flush=True)


def measure_scenes(chainreel, scenes, rounds):
    stages = ["prepare", "simulate", "shapes", "pixels", "convert", "encode", "mux", "rest"]
    with open(HERE / "results" / "films.csv", "w", newline="") as file:
        rows = csv.writer(file, lineterminator="\n")
        rows.writerow(["film", "frames", "threads", "ours s", "encoder alone s", "ratio", "ours CPU s", "encoder alone CPU s", "ratio of CPU",
                       "one encoder s", "ratio to it",
                       *(f"{stage} CPU ms a frame" for stage in stages)])
        for scene in scenes:
            run = subprocess.run([chainreel, "bench", str(scene), "--json", "--quiet", "--rounds", str(rounds), "--set", "video.width=1920",
                                  "--set", "video.height=1080", "--set", "video.fps=60"], capture_output=True, text=True)
            if run.returncode:
                print(f"{scene.stem}: {run.stderr.strip()}", flush=True)
                continue
            film = json.loads(run.stdout)["films"][0]
            ours, alone, ratio, one = film["whole"], film["encoder_alone"], film["ratio"], film["one_encoder"]
            rows.writerow([scene.stem, film["frames"], film["jobs"], f"{ours['wall']:.2f}", f"{alone['wall']:.2f}", f"{ratio['wall']:.3f}",
                           f"{ours['cpu']:.2f}", f"{alone['cpu']:.2f}", f"{ratio['cpu']:.3f}",
                           f"{one['wall']:.2f}", f"{film['ratio_to_one_encoder']['wall']:.3f}",
                           *(f"{film['stages'][stage]['cpu_ms']:.3f}" for stage in stages)])
            file.flush()
            print(f"{scene.stem:20} {film['frames']:5} frames {ours['wall']:6.2f} s, encoder alone {alone['wall']:6.2f} s: "
                  f"{ratio['wall']:.2f}, CPU {ratio['cpu']:.2f}", flush=True)


def main():
    if sys.argv[1:2] == ["--make"]:
        what, target, *more = sys.argv[2:]
        return {"page": lambda film: film_of_matplotlib(film, True), "matplotlib": lambda film: film_of_matplotlib(film, False), "cairo": film_of_cairo,
                "mujoco": lambda film: film_of_mujoco(*more, film)}[what](target)
    words = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    words.add_argument("chainreel")
    words.add_argument("mujoco_film", nargs="?")
    words.add_argument("--rounds", type=int, default=2)
    words.add_argument("--scenes", nargs="*", type=Path, default=sorted(SCENES.glob("*.yaml")))
    words = words.parse_args()
    measure_peers(words.chainreel, words.mujoco_film, words.rounds)
    measure_scenes(words.chainreel, words.scenes, words.rounds)


if __name__ == "__main__":
    main()
