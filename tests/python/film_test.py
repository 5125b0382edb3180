"""Films and pictures of runs: the program's own."""

import base64
import locale
import os
import re
import shutil
import signal
import subprocess
import sys
import threading
import time
import unittest
import warnings

import numpy as np

import chainreel as cr
from support import FolderTest, program

SMALL = {"duration": 0.4, "method": "rk4", "step": 0.001, "video": {"width": 320, "height": 180}}


def read(path: str) -> bytes:
    with open(path, "rb") as file:
        return file.read()


class Films(FolderTest):
    def setUp(self):
        super().setUp()
        for name in ("rr.urdf",):
            shutil.copy(os.path.join("models", name), self.folder)
        self.scene = self.write("swing.yaml", "model: rr.urdf\nstart: {q: [0.3, 1]}\nduration: 0.4\nmethod: rk4\n"
                                              "step: 0.001\nvideo: {width: 320, height: 180}\n")

    def test_a_film_has_the_bytes_of_the_commands(self):
        os.makedirs(self.path("theirs"))
        theirs = self.path("theirs/swing.mp4")
        program("render", self.scene, "-o", theirs, "--quiet")
        run = cr.Scene(self.scene).run()
        self.assertEqual(run.film(self.path("swing.mp4"), self.path("swing.gif")), [self.path("swing.mp4"), self.path("swing.gif")])
        self.assertEqual(read(self.path("swing.mp4")), read(theirs))
        self.assertTrue(os.path.exists(self.path("swing.json")))
        with self.assertRaises(cr.Error) as caught:
            run.film(self.path("swing.mp4"))
        self.assertEqual(caught.exception.code, 6)
        run.film(self.path("swing.mp4"), overwrite=True)

    def test_a_frame_is_the_snapshot(self):
        run = cr.Scene(self.scene).run()
        frame = run.frame(0.2)
        self.assertEqual((frame.shape, frame.dtype), ((180, 320, 4), np.uint8))
        self.assertTrue((frame[..., 3] == 255).all())
        program("snapshot", self.scene, "--at", "0.2", "-o", self.path("theirs.png"), "--quiet")
        run.picture(self.path("ours.png"), 0.2)
        program("compare", self.path("ours.png"), self.path("theirs.png"))
        self.assertEqual(read(self.path("ours.png")), read(self.path("theirs.png")))
        self.assertEqual(run.frame(0.2, 160, 90).shape, (90, 160, 4))
        np.testing.assert_array_equal(run.frame(0.2), frame)
        for bad in (-1, 0.5, float("nan")):
            with self.assertRaises(cr.Error):
                run.frame(bad)

    def test_colours_are_red_green_blue(self):
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", cr.RunWarning)  # of colours too pale for it
            page = cr.Scene(self.scene, style={"light": {"background": "#ff8000"}}).run().frame(0)
        self.assertEqual(tuple(page[0, 0]), (255, 128, 0, 255))

    def test_a_film_of_a_python_torque_is_drawn_and_told(self):
        run = cr.Scene(self.scene, torque=lambda t, q, qd: [1, 0]).run()
        run.film(self.path("pushed.mp4"))
        with open(self.path("pushed.txt"), encoding="utf-8") as file:
            self.assertIn("torques of the Python function <lambda>", file.read())

    def test_what_is_not_shown_is_a_warning_and_nothing_goes_to_standard_error(self):
        code = f"""
import warnings, chainreel as cr
warnings.simplefilter("error")
run = cr.Scene({self.scene!r}, torque=["sin(t)", "-qd2"], plot=["energy"], layout="scene-below", set={{"events": [{{"when": "t - 9", "name": "never"}}],
                                     "slow_motion": [{{"event": "never", "from": 0, "until": 0.1, "speed": 0.5}}]}}).run()
for make in (lambda: run.film({self.path("slow.mp4")!r}), lambda: run.frame(0.1, 120, 60)):
    try:
        make()
        print("nothing")
    except cr.RunWarning as warning:
        print(warning)
"""
        result = subprocess.run([sys.executable, "-B", "-c", code], capture_output=True, text=True, check=False)
        film, small = result.stdout.splitlines()
        self.assertIn("no slow motion about 'never'", film)
        self.assertIn("120 x 60 px have no room for more", small)
        self.assertEqual(result.stderr, "")

    def test_a_notebook_shows_the_film(self):
        html = cr.Scene(self.scene).run()._repr_html_()
        data = re.search(r"data:video/mp4;base64,([^\"]+)", html).group(1)
        self.assertEqual(base64.b64decode(data)[4:8], b"ftyp")

    def test_instants_of_ones_own_do_not_change_the_film(self):
        cr.Scene(self.scene).run([0, 0.1]).film(self.path("few.mp4"))
        cr.Scene(self.scene).run().film(self.path("all.mp4"))
        self.assertEqual(read(self.path("few.mp4")), read(self.path("all.mp4")))

    def test_ctrl_c_leaves_no_file(self):
        run = cr.Scene(self.scene, duration=100).run()
        before = sorted(os.listdir(self.folder))

        def interrupt():
            while sorted(os.listdir(self.folder)) == before:
                time.sleep(0.001)
            os.kill(os.getpid(), signal.SIGINT)

        thread = threading.Thread(target=interrupt)
        thread.start()
        with self.assertRaises(KeyboardInterrupt):
            run.film(self.path("long.mp4"))
        thread.join()
        self.assertEqual(sorted(os.listdir(self.folder)), before)

    def test_a_language_with_commas_changes_no_number(self):
        def files(name):
            run = cr.Scene(self.scene, set={"video.crf": 18.5}).run()
            return [read(path) for path in run.film(*(self.path(name + ending) for ending in (".mp4", ".svg", ".csv")))]

        expected = files("plain")
        source = self.write("comma.src", 'LC_NUMERIC\ndecimal_point ","\nthousands_sep "."\ngrouping 3;3\nEND LC_NUMERIC\n')
        subprocess.run(["localedef", "-c", "-f", "UTF-8", "-i", source, self.path("comma.UTF-8")], capture_output=True,
                       check=False)  # it misses all that is not about numbers
        os.environ["LOCPATH"] = self.folder
        try:
            locale.setlocale(locale.LC_NUMERIC, "comma.UTF-8")
            self.assertEqual(locale.str(1.5), "1,5")
            self.assertEqual(files("comma"), expected)
            self.assertEqual(locale.str(1.5), "1,5")  # it stays the caller's
        finally:
            locale.setlocale(locale.LC_NUMERIC, "C")

    def test_names_that_say_nothing_are_refused(self):
        run = cr.Scene(self.scene).run()
        with self.assertRaises(cr.Error) as caught:
            run.film(self.path("film.xyz"))
        self.assertEqual(caught.exception.code, 2)
        with self.assertRaises(TypeError):
            run.film()
        with self.assertRaises(cr.Error):
            run.film(self.path("a.mp4"), jobs=-1)
        with self.assertRaises(cr.Error):
            run.film(self.path("a.mp4"), at=9)
        self.assertFalse([name for name in os.listdir(self.folder) if name.startswith(".") or name == "a.mp4"])


if __name__ == "__main__":
    unittest.main()
