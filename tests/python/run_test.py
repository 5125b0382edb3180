"""Runs: their numbers, whose memory they are, torques of Python, what goes wrong."""

import functools
import gc
import os
import re
import signal
import threading
import time
import unittest
import warnings

import numpy as np

import chainreel as cr
from support import FolderTest, program, program_json

RR = os.path.abspath("models/rr.urdf")
FALL = {"model": RR, "gravity": [0, -9.81, 0], "start": {"q": [0.3, 1]}, "duration": 0.5, "method": "rk4", "step": 0.001}


class Runs(FolderTest):
    def test_states_are_those_that_simulate_writes(self):
        for scene in ("rr_free", "rr_torque", "rrr_torque"):
            file = f"assets/scenes/{scene}.yaml"
            # What chooses its method is as exact as a film's here, and closer in tables.
            as_films = ["--set", "accuracy=0.1 px"] if scene == "rrr_torque" else []
            report = program_json("simulate", file, *as_films, "--set", "duration=1", "--columns", "t,q,qd", "-o", self.path(scene + ".csv"))
            table = np.loadtxt(self.path(scene + ".csv"), delimiter=",", skiprows=1)
            with warnings.catch_warnings():
                warnings.simplefilter("ignore", cr.RunWarning)
                run = cr.Scene(file, duration=1).run()
            np.testing.assert_array_equal(np.column_stack([run.t, run.q, run.qd]), table)
            ours = run.report
            self.assertEqual({key: ours[key] for key in ("trajectory_sha256", "method", "energy_start", "energy_error")},
                             {key: report[key] for key in ("trajectory_sha256", "method", "energy_start", "energy_error")})

    def test_a_table_has_what_simulate_writes_and_the_equation_of_motion_holds_in_it(self):
        run = cr.Scene("assets/scenes/four_bar.yaml", duration=0.5).run()
        table = run.table("t,q,qd,qdd,tau,lambda,frames")
        rows = len(table["t"])
        self.assertEqual(table["qdd"].shape, run.q.shape)
        self.assertEqual(table["lambda"].shape[0], rows)
        self.assertEqual(table["frames"].shape[0], rows)
        pendulum = cr.Scene(dict(FALL)).run()
        model, table = cr.load(RR), pendulum.table()
        for row in range(0, len(table["t"]), 7):
            q, qd, qdd = table["q"][row], table["qd"][row], table["qdd"][row]
            # Two ways to the same torque: some 30 N m, rounded.
            np.testing.assert_allclose(model.inverse(q, qd, qdd), table["tau"][row], atol=1e-11)
        for wrong in ("t,colour", "lambda", ""):
            with self.assertRaises(cr.Error):
                pendulum.table(wrong)

    def test_a_dict_is_a_scene(self):
        text = "\n".join(f"{key}: {value}" for key, value in
                         {**FALL, "start": "{q: [0.3, 1]}", "torque": "[sin(t), 0]"}.items())
        by_file = cr.Scene(self.write("scene.yaml", text)).run()
        by_dict = cr.Scene({**FALL, "start": {"q": np.array([0.3, 1])}, "torque": ["sin(t)", 0]}).run()
        np.testing.assert_array_equal(by_file.q, by_dict.q)
        by_keys = cr.Scene(FALL, torque=["sin(t)", 0], set={"video.fps": 30}).run()
        np.testing.assert_array_equal(by_keys.q, by_dict.q[::2])

    def test_a_key_given_twice_is_an_error(self):
        with self.assertRaisesRegex(TypeError, "duration: given as an argument and in set"):
            cr.Scene(FALL, set={"duration": 0.2}, duration=0.3)

    def test_energy_is_what_the_model_says(self):
        run = cr.Scene({**FALL, "torque": ["sin(t)", "-qd2"]}).run()
        model = cr.load(RR, gravity=[0, -9.81, 0])
        np.testing.assert_array_equal([sum(model.energy(q, qd)) for q, qd in zip(run.q, run.qd)], run.energy)
        np.testing.assert_array_equal(run.kinetic + run.potential, run.energy)
        # The C library's sine and ours are each right to half a unit in the last place.
        np.testing.assert_allclose(run.tau, np.column_stack([np.sin(run.t), -run.qd[:, 1]]), rtol=0, atol=1e-15)
        np.testing.assert_allclose(run.energy_error, run.energy - run.energy[0] - run.work, rtol=0, atol=1e-12)

    def test_views_outlive_the_run_and_cannot_be_written(self):
        run = cr.Scene(FALL).run()
        views = [run.t, run.q, run.qd, run.tau, run.energy, run.work, run.kinetic, run.potential, run.energy_error]
        self.assertTrue(np.shares_memory(run.q, views[1]))
        self.assertTrue(np.shares_memory(run.tau, views[3]))
        for view in views:
            self.assertFalse(view.flags.owndata)
            with self.assertRaises(ValueError):
                view[0] = 1
            with self.assertRaises(ValueError):
                view.setflags(write=True)
        copies = [view.copy() for view in views]
        del run, view
        gc.collect()
        others = [cr.Scene(FALL, step=0.002).run() for _ in range(4)]  # would take the memory that was given back
        for view, copy in zip(views, copies):
            np.testing.assert_array_equal(view, copy)
        del others

    def test_instants_of_ones_own(self):
        times = np.linspace(0, 0.5, 7)
        run = cr.Scene(FALL).run(times)
        np.testing.assert_array_equal(run.t, times)
        self.assertEqual(len(cr.Scene(FALL).run(0.3).t), 1)
        with self.assertRaisesRegex(ValueError, "2 axes"):
            cr.Scene(FALL).run([[0.1, 0.2]])
        for bad in ([0.2, 0.1], [0, 9], [np.nan]):
            with self.assertRaisesRegex(cr.Error, "must rise"):
                cr.Scene(FALL).run(bad)
        with self.assertRaises(ValueError):
            cr.Scene(FALL).run([])

    def test_a_comparison_has_panels(self):
        run = cr.Scene({**FALL, "compare": [{"method": "rk4"}, {"method": "semi_implicit_euler"}]}).run()
        self.assertEqual([panel.report["method"] for panel in run.panels], ["rk4", "semi_implicit_euler"])
        self.assertFalse(np.array_equal(run.panels[0].q, run.panels[1].q))
        for name in ("q", "energy", "report", "title", "events", "status"):
            with self.assertRaisesRegex(cr.Error, r"take those of run.panels"):
                getattr(run, name)
        repr(run)

    def test_events_have_names_and_instants(self):
        run = cr.Scene({**FALL, "events": [{"when": "q1", "name": "level"}]}).run()
        self.assertTrue(run.events)
        name, t = run.events[0]
        self.assertEqual(name, "level")
        # Between the two samples where q1 changes its sign.
        before = np.searchsorted(run.t, t) - 1
        self.assertLess(run.q[before, 0] * run.q[before + 1, 0], 0)

    def test_a_python_torque_is_its_expression(self):
        def push(t, q, qd):
            return [2 * t, -3 * qd[1]]

        run = cr.Scene(FALL, torque=push).run()
        np.testing.assert_array_equal(run.q, cr.Scene(FALL, torque=["2 * t", "-3 * qd2"]).run().q)
        np.testing.assert_array_equal(run.q, cr.Scene({**FALL, "torque": push}).run().q)
        with self.assertRaisesRegex(ValueError, "has a torque already"):
            cr.Scene({**FALL, "torque": push}, torque=push)
        self.assertIn("the Python function push (run_test.py:", run.scene)
        with self.assertRaisesRegex(cr.Error, "which no file holds"):
            cr.Scene(self.write("again.yaml", run.scene)).run()
        np.testing.assert_array_equal(run.q, cr.Scene({**FALL, "torque": [1, 1]}, torque=push).run().q)
        with self.assertRaisesRegex(ValueError, "give one of them"):
            cr.Scene(FALL, torque=push, set={"torque": [1, 1]})
        with self.assertRaisesRegex(cr.Error, "torque of its own"):  # of panels each its own
            cr.Scene({**FALL, "compare": [{"torque": [1, 1]}, {"torque": [2, 1]}]}, torque=push).run()
        log = self.write("log.csv", "t,q1,q2\n0,0,0\n0.5,0.1,0\n1,0.4,0\n")
        replay = cr.Scene({"model": RR, "motion": log}).run()
        self.assertEqual(replay.t[-1], 1)
        with self.assertRaisesRegex(cr.Error, "recorded motion"):
            cr.Scene({"model": RR, "motion": log}, torque=push).run()
        kept = []
        cr.Scene(FALL, torque=lambda t, q, qd: kept.append(q) or [0, 0]).run()
        self.assertFalse(np.array_equal(kept[0], kept[-1]))  # copies: they may be kept

    def test_what_a_torque_raises_is_raised(self):
        class Own(Exception):
            pass

        def fail(t, q, qd):
            if t > 0.1:
                raise Own("at a tenth")
            return [0, 0]

        for method in ({}, {"method": "auto", "step": None}):
            with self.assertRaisesRegex(Own, "at a tenth"):
                cr.Scene(FALL, torque=fail, **method).run()
        for bad, kind in ((lambda t, q, qd: [1], ValueError), (lambda t, q, qd: [[1, 2]], ValueError),
                          (lambda t, q, qd: "ab", TypeError), (lambda t, q, qd: None, (TypeError, ValueError, cr.Error)),
                          (lambda: [0, 0], TypeError), (lambda t, q, qd: [float("nan"), 0], cr.Error)):
            with self.assertRaises(kind):
                cr.Scene(FALL, torque=bad).run()

    def test_a_torque_that_is_none_is_told_with_what_it_has_to_give(self):
        def late(t, q, qd):
            return [0, 0] if t < 0.1 else [float("nan"), 0]

        wanted = r" at t = 0\.?\d* s: return 2 numbers, one a freedom in the order of qd, N m or N"
        for bad, gave in ((lambda t, q, qd: [1], "1 number"), (lambda t, q, qd: [1, 2, 3], "3 numbers"),
                          (lambda t, q, qd: [[1, 2]], "an array of 2 dimensions"), (lambda t, q, qd: None, r"nothing \(None\)"),
                          (lambda t, q, qd: ["a", 1], r"what are no numbers \(list\)")):
            with self.assertRaisesRegex((TypeError, ValueError), r"the Python function <lambda> \(run_test.py:\d+\) gave " + gave + wanted):
                cr.Scene(FALL, torque=bad).run()
        with self.assertRaisesRegex(cr.Error, r"joint1.*not a finite number at t = 0\.099 s .*the Python function late .* must give finite numbers") as caught:
            cr.Scene(FALL, torque=late).run()
        self.assertNotIn("smaller step", str(caught.exception))

    def test_films_say_the_name_of_a_torque(self):
        def hold_up_2(t, q, qd):
            return [1.0, 0.5]

        def words(torque):
            run = cr.Scene({**FALL, "duration": 0.1}, torque=torque).run()
            run.picture(self.path("a.svg"), 0, overwrite=True)
            with open(self.path("a.svg"), encoding="utf-8") as file:
                return run, "".join(re.sub(r"<[^>]*>|\s", "", text) for text in re.findall(r"<text.*?</text>", file.read(), re.S))

        run, page = words(hold_up_2)
        with self.assertRaisesRegex(cr.Error, "give overwrite=True"):
            run.picture(self.path("a.svg"), 0)
        self.assertIn("hold_up_2(", page)
        self.assertIn("the Python function hold_up_2", run.report["torque_function"])
        self.assertIn("the Python function hold_up_2", run.scene)
        for odd in (lambda t, q, qd: [0, 0], functools.partial(hold_up_2), type("Caller", (), {"__call__": lambda self, t, q, qd: [0, 0]})()):
            self.assertNotIn("hold", words(odd)[1])  # tau(t, q, qd)
        hold_up_2.__name__ = "frac{_^"
        self.assertNotIn("frac", words(hold_up_2)[1])

    def test_errors_name_file_and_line(self):
        path = self.write("scene.yaml", f"model: {RR}\nduration: 1\nmethod: rk4\nstep: -1\nplott: 1\n")
        with self.assertRaises(cr.Error) as caught:
            cr.Scene(path).run()
        error = caught.exception
        self.assertEqual((error.code, error.file, error.line), (3, path, 4))
        self.assertEqual([problem.line for problem in error.problems], [4, 5])
        with self.assertRaises(cr.Error) as caught:  # a text that its caller never saw has no lines
            cr.Scene({**FALL, "methd": 1}).run()
        self.assertEqual(caught.exception.line, 0)
        self.assertIn("did you mean 'method'", str(caught.exception))
        for bad in ({"duration": float("nan")}, {"duration": float("inf")}):
            with self.assertRaises(ValueError):
                cr.Scene({**FALL, **bad})
        with self.assertRaises(TypeError):
            cr.Scene({**FALL, "title": object()})
        with self.assertRaisesRegex(cr.Error, "no such file"):
            cr.Scene("nowhere.yaml").run()

    def test_what_speaks_against_a_run_is_a_warning(self):
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            cr.Scene("rr_free", duration=10).run()
        self.assertTrue(any(issubclass(one.category, cr.RunWarning) and "energy is off" in str(one.message) for one in caught))
        with self.assertRaises(cr.Error) as failed:
            cr.Scene({**FALL, "duration": 100, "method": "explicit_euler", "step": 0.2}).run()
        self.assertEqual(failed.exception.code, 5)

    def test_other_threads_go_on_and_ctrl_c_ends_it(self):
        count = [0]

        def others():
            begin = time.process_time()
            while time.process_time() - begin < 0.3:  # which the run alone can use
                count[0] += 1
                time.sleep(0.001)
            os.kill(os.getpid(), signal.SIGINT)

        thread = threading.Thread(target=others)
        thread.start()
        long = {**FALL, "duration": 3000, "step": 0.0001}  # ten seconds and more
        with self.assertRaises(KeyboardInterrupt):
            cr.Scene(long).run()
        thread.join()
        self.assertGreater(count[0], 10)
        self.assertIs(signal.getsignal(signal.SIGINT), signal.default_int_handler)
        cr.Scene(FALL).run()  # the signal is forgotten
        self.assertIsNotNone(program("doctor"))

    def test_runs_of_several_threads_do_not_meet(self):
        expected = cr.Scene(FALL).run().q.copy()
        results = [None] * 4

        def work(i):
            results[i] = cr.Scene(FALL, torque=lambda t, q, qd: [0.0, 0.0]).run().q

        threads = [threading.Thread(target=work, args=(i,)) for i in range(4)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        for q in results:
            np.testing.assert_array_equal(q, expected)


if __name__ == "__main__":
    unittest.main()
