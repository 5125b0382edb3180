"""Models: the terms of the equation of motion."""

import ast
import inspect
import os
import pickle
import struct
import unittest
import warnings
from pathlib import Path

import numpy as np

import chainreel as cr
from chainreel import _native
from chainreel._errors import in_python
from support import FolderTest, program_json

DAMPED = """<robot name="damped">
  <link name="base"/>
  <link name="rod"><inertial><origin xyz="0 -0.5 0"/><mass value="2"/>
    <inertia ixx="0.1" iyy="0.1" izz="0.1" ixy="0" ixz="0" iyz="0"/></inertial></link>
  <joint name="hinge" type="continuous"><parent link="base"/><child link="rod"/><axis xyz="0 0 1"/>
    <dynamics damping="0.5" friction="0.25"/></joint>
</robot>"""


class Models(FolderTest):
    def test_numbers_are_those_of_the_program(self):
        for name, q, qd in (("rr.urdf", [0.3, 1.2], [1, -2]), ("rrr.urdf", [0.1, 0.2, -0.7], [3, 2, 1]),
                            ("pp.urdf", [0.5, 0.25], [1, 2])):
            model = cr.load("models/" + name)
            tau = [0.5 * k for k in range(1, model.nv + 1)]
            words = {"--q": q, "--qd": qd, "--tau": tau}
            numbers = program_json("dynamics", "models/" + name,
                                   *[word for key, values in words.items() for word in (key, ",".join(map(str, values)))])
            for ours, theirs in ((model.M(q), "M"), (model.C(q, qd), "C"), (model.nle(q, qd), "nle"), (model.gravity(q), "tau_g"),
                                 (model.friction(qd), "tau_f"), (model.forward(q, qd, tau), "qdd"), (model.jacobian(q), "J"),
                                 (model.Lambda_inv(q), "Lambda_inv"), (model.Lambda(q), "Lambda"), (model.position(q), "x"),
                                 (np.array(model.energy(q, qd)), None)):
                expected = numbers[theirs] if theirs else [numbers["kinetic"], numbers["potential"]]
                np.testing.assert_array_equal(ours.ravel(), np.ravel(expected), err_msg=f"{name} {theirs}")

    def test_two_point_masses_have_the_lectures_matrices(self):
        model = cr.load("rr.urdf")  # m = 1 kg at the end of each link of 1 m
        q1, q2 = 0.3, 1.2
        c2, s2 = np.cos(q2), np.sin(q2)
        # Some ten operations of order one.
        near = {"rtol": 0, "atol": 1e-14}
        np.testing.assert_allclose(model.M([q1, q2]), [[3 + 2 * c2, 1 + c2], [1 + c2, 1]], **near)
        np.testing.assert_allclose(model.C([q1, q2], [1, 2]) @ [1, 2], [-s2 * (2 * 1 * 2 + 2 * 2), s2], **near)
        np.testing.assert_allclose(model.gravity([q1, q2]), [9.81 * (2 * np.cos(q1) + np.cos(q1 + q2)), 9.81 * np.cos(q1 + q2)],
                                   rtol=0, atol=1e-13)
        J = model.jacobian([q1, q2])
        np.testing.assert_allclose(J, [[-np.sin(q1) - np.sin(q1 + q2), -np.sin(q1 + q2)],
                                       [np.cos(q1) + np.cos(q1 + q2), np.cos(q1 + q2)]], **near)
        np.testing.assert_allclose(model.Lambda([q1, q2]), np.linalg.inv(J @ np.linalg.inv(model.M([q1, q2])) @ J.T),
                                   rtol=1e-12)

    def test_inverse_dynamics_undo_forward_dynamics_with_friction_too(self):
        model = cr.load(self.write("damped.urdf", DAMPED), gravity=[0, -9.81, 0])
        np.testing.assert_allclose(model.friction([2]), [0.5 * 2 + 0.25])
        np.testing.assert_allclose(model.forward([0.4], [2], model.inverse([0.4], [2], [3])), [3], rtol=1e-14)
        self.assertEqual(cr.load(self.path("damped.urdf"), friction=False).friction([2])[0], 0)

    def test_a_chain_of_numbers_needs_no_file(self):
        model = cr.load(links=[0.5, 0.4, 0.3], masses=[2, 1.5, 1], joints="RRR", shape="point")
        self.assertEqual((model.nq, model.nv), (3, 3))
        np.testing.assert_allclose(model.M([0, 0, 0])[2, 2], 1 * 0.3**2, rtol=1e-12)
        with self.assertRaises(TypeError):
            cr.load()
        with self.assertRaises(TypeError):
            cr.load("rr.urdf", links=[1])
        with self.assertRaises(cr.Error) as caught:
            cr.load(links=[-1])
        self.assertEqual((caught.exception.code, caught.exception.line), (3, 0))

    def test_a_file_that_is_not_here_is_said_to_be_the_programs_own(self):
        for ask in (lambda: cr.load("rr.urdf"), lambda: cr.Scene({"model": "rr.urdf"}), lambda: cr.Scene("pp_free.yaml").run([0, 0.1])):
            with warnings.catch_warnings(record=True) as caught:
                warnings.simplefilter("always")
                ask()
            said = [one for one in caught if "the program's own is taken" in str(one.message)]
            self.assertEqual([one.filename for one in said], [__file__], [str(one.message) for one in caught])
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            cr.load("models/rr.urdf")
            cr.Scene("pp_free").run([0, 0.1])

    def test_arrays_are_copies(self):
        model = cr.load("rr.urdf")
        M = model.M([0, 0])
        before = M.copy()
        model.M([0, 2])
        np.testing.assert_array_equal(M, before)
        M[0, 0] = 7
        self.assertNotEqual(model.M([0, 0])[0, 0], 7)

    def test_what_is_no_state_is_refused(self):
        model = cr.load("rr.urdf")
        for q in ([1], [1, 2, 3], [[1, 2]], [np.nan, 0], [np.inf, 0], 3):
            with self.assertRaises(cr.Error) as caught:
                model.M(q)
            self.assertEqual(caught.exception.code, 2, q)
        for q in ("ab", None, {}, [None, 1]):
            with self.assertRaises((TypeError, cr.Error), msg=repr(q)):
                model.M(q)
        with self.assertRaisesRegex(cr.Error, "did you mean 'gripper'"):
            model.jacobian([0, 0], "griper")
        with self.assertRaisesRegex(cr.Error, "none of linear, full"):
            model.jacobian([0, 0], task="both")
        with self.assertRaisesRegex(cr.Error, "singular"):
            model.Lambda([0, 0])

    def test_errors_name_file_and_line(self):
        path = self.write("broken.urdf", DAMPED.replace('<mass value="2"/>', '<mass value="heavy"/>'))
        with self.assertRaises(cr.Error) as caught:
            cr.load(path)
        error = caught.exception
        self.assertEqual((error.code, error.file, error.line), (3, path, 3))
        self.assertIn(f"{path}:3", str(error))
        again = pickle.loads(pickle.dumps(error))
        self.assertEqual((str(again), again.code, again.problems), (str(error), error.code, error.problems))
        with self.assertRaisesRegex(cr.Error, "means nothing to `load`"):
            cr.load("rr.urdf", duration=3)

    def test_what_the_command_line_advises_is_said_in_python(self):
        several = self.write("fork.urdf", """<robot name="fork"><link name="base"/>
          <link name="a"><inertial><mass value="1"/><inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial></link>
          <link name="b"><inertial><mass value="1"/><inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial></link>
          <joint name="ja" type="continuous"><parent link="base"/><child link="a"/><axis xyz="0 0 1"/></joint>
          <joint name="jb" type="continuous"><parent link="base"/><child link="b"/><axis xyz="0 0 1"/></joint></robot>""")
        with self.assertRaises(cr.Error) as caught:
            cr.load(several).Lambda([0, 0])
        self.assertIn('`end_effector="NAME"`', str(caught.exception))
        self.assertNotIn("--set", str(caught.exception))
        self.assertEqual(in_python("take --set step=null --set method=radau5, or --set 'accuracy=0.1 px'; --set step=0.01"),
                         'take step=None, method="radau5", or accuracy="0.1 px"; step=0.01')
        self.assertEqual(in_python("--set video.fps=120 --set step=1"), 'set={"video.fps": 120, "step": 1}')
        self.assertEqual(in_python("-o e.txt: pictures"), "e.txt: pictures")
        self.assertEqual(in_python("at 1 place (--set slow_motion=none): t = 1 s"), 'at 1 place (slow_motion="none"): t = 1 s')
        self.assertEqual(in_python("no setting"), "no setting")
        with self.assertWarns(cr.RunWarning) as warned:
            cr.Scene("rr_free", set={"method": "explicit_euler", "step": 0.01, "duration": 1, "accuracy": None}).run()
        words = "\n".join(str(one.message) for one in warned.warnings)
        self.assertIn("step=", words)
        self.assertNotIn("--set", words)

    def test_an_ellipse_shows_itself(self):
        ellipse = cr.load("rr.urdf").ellipse([0.3, 1.2])
        self.assertTrue(ellipse._repr_svg_().lstrip().startswith("<"))
        self.assertIn("</svg>", ellipse.svg)
        self.assertLess(ellipse.mobility[0], ellipse.mobility[1])
        for name, begin in (("e.svg", b"<svg "), ("e.png", b"\x89PNG"), ("e.pdf", b"%PDF")):
            ellipse.save(self.path(name))
            with open(self.path(name), "rb") as file:
                self.assertEqual(file.read(len(begin)), begin)
            with self.assertRaisesRegex(cr.Error, "exists already"):
                ellipse.save(self.path(name))
            ellipse.save(self.path(name), overwrite=True)
        ellipse.save(self.path("wide.png"), width=800, height=300)
        with open(self.path("wide.png"), "rb") as file:
            self.assertEqual(struct.unpack(">II", file.read(24)[16:]), (800, 300))
        with self.assertRaisesRegex(cr.Error, "e.txt: pictures are written as .png, .svg or .pdf"):
            ellipse.save(self.path("e.txt"))
        with self.assertRaisesRegex(cr.Error, "none of mass, energy, belt"):
            cr.load("rr.urdf").ellipse([0, 1], "weight")

    def test_numbers_and_rows_of_denavit_and_hartenberg_are_models_as_files_are(self):
        file, q = cr.load("rr.urdf"), [0.3, 1.2]
        rows = [[1, 0, 0, 0], [1, 0, 0, 0]]
        for model in (cr.load(links=[1, 1], masses=1, shape="point"), cr.load(dh=rows, masses=[1, 1], shape="point"),
                      cr.load(dh=np.array(rows), masses=1, shape="point", convention="standard", efforts=20)):
            np.testing.assert_allclose(model.Lambda_inv(q), file.Lambda_inv(q), rtol=1e-12)  # round-off of two writings
            self.assertIn("</svg>", model.ellipse(q).svg)
        damped = cr.load(links=[1, 1], damping=[0.5, 0])
        np.testing.assert_allclose(damped.friction([2, 1]), [1, 0])
        with self.assertRaisesRegex(cr.Error, "dh"):
            cr.load(dh=[[1, 0, 0]])
        with self.assertRaisesRegex(TypeError, r"in its place links= \(or dh=\)"):
            cr.load("rr.urdf", dh=rows)

    def test_all_that_is_public_says_what_it_is(self):
        for kind in (cr.Model, cr.Ellipse, cr.Scene, cr.Run, cr.Panel, cr.Error):
            self.assertTrue(inspect.getdoc(kind), kind)
            for name, value in vars(kind).items():
                if not name.startswith("_") and (callable(value) or isinstance(value, property)):
                    if (kind, name) != (cr.Error, "with_traceback"):
                        self.assertTrue(inspect.getdoc(value), f"{kind.__name__}.{name}")

    def test_the_stub_names_what_the_module_has(self):
        stub = Path("src/python/chainreel/_native.pyi").read_text(encoding="utf-8")
        told = {}
        for item in ast.parse(stub).body:
            if isinstance(item, ast.ClassDef):
                told[item.name] = {part.name for part in item.body if isinstance(part, ast.FunctionDef)} - {"__init__"}
        for name, parts in told.items():
            there = {part for part in vars(getattr(_native, name)) if not part.startswith("_")}
            self.assertEqual(parts, there, name)
        classes = {name for name, value in vars(_native).items() if inspect.isclass(value)}
        self.assertEqual(set(told), classes)
        self.assertTrue(os.path.exists(os.path.join(os.path.dirname(cr.__file__), "py.typed")))


if __name__ == "__main__":
    unittest.main()
