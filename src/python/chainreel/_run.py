"""A scene, its run, and what is made of that."""

from __future__ import annotations

import base64
import json
import os
import tempfile
import warnings
from typing import Any, Callable, Dict, List, Mapping, Optional, Tuple, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _native
from ._errors import Error, RunWarning, in_python
from ._keys import found, overrides_of, text_of

Torque = Callable[[float, NDArray[np.float64], NDArray[np.float64]], ArrayLike]


class Scene:
    """What is asked for: a scene file, the name of one that comes with chainreel, or a dict with the keys of a scene.

        Scene("rr_free", duration=2)
        Scene({"model": "rr.urdf", "start": {"q": [0.3, 1.2]}, "torque": [0, "-2 * qd2"]})
        Scene("arm.yaml", set={"video.fps": 30, "draw": ["chain", "trail"]})

    keys, set: change keys of it, as `--set` does; None takes a key away. A dict's paths start in the working folder;
    its model may also be the name of one that comes with chainreel.
    torque: a function of t (s), q (nq,) and qd (nv,) that gives nv numbers, N m or N, in the place of the scene's own
    torque; a dict may hold it, too. It must depend on its arguments alone: it is asked several times of each instant, not in the order of time. It is slow: each
    question takes some microseconds, where an expression in the scene takes some 10 ns, and `method: auto` asks a hundred
    thousand of them; give a method, or write the torque as text where it is one. Films show and remember what it is called, and
    cannot be made again from that.
    Nothing is read before `run`.
    """

    def __init__(self, scene: Union[str, os.PathLike, Mapping[str, Any]], *, set: Optional[Mapping[str, Any]] = None,
                 torque: Optional[Torque] = None, name: str = "scene", **keys: Any):
        if torque is not None and not callable(torque):
            keys["torque"], torque = torque, None
        if isinstance(scene, Mapping) and callable(scene.get("torque")):
            if torque is not None or "torque" in keys:
                raise ValueError("the scene has a torque already, the function of its key torque: give one of them")
            torque = scene["torque"]
            scene = {key: value for key, value in scene.items() if key != "torque"}
        self._text = text_of(_with_model(scene)) if isinstance(scene, Mapping) else None
        self._path = name if isinstance(scene, Mapping) else os.fspath(scene)
        twice = [key for key in keys if key in (set or {})]
        if twice:
            raise TypeError(f"{', '.join(twice)}: given as an argument and in set")
        if torque is not None and "torque" in (set or {}):
            raise ValueError("a torque is set, and a function given: give one of them")
        replaced = {} if torque is None else {"torque": None}  # a function stands for what the scene has, as a text would
        self._overrides = overrides_of({**replaced, **keys, **(set or {})})
        self._torque = torque

    def __repr__(self) -> str:
        return f"<chainreel.Scene {self._path!r}>"

    def run(self, times: Optional[ArrayLike] = None) -> "Run":
        """Runs it, at the frames of its film (but for slow motion that it has by itself) and at the end, or sampled at `times` (s, rising).

        Throws Error, with file and line, of whatever is wrong with the scene, and where the run does not end as the scene
        expects; what the torque function raises is raised. What speaks against the run is a RunWarning. Other threads go on.
        Where `method: auto` chooses, it is as exact as its film, 0.1 px; numbers may want more: Scene(.., accuracy="1e-8 relative").
        """
        instants = np.atleast_1d(np.asarray([] if times is None else times, dtype=float))
        if instants.ndim > 1:
            raise ValueError(f"times has {instants.ndim} axes: give one instant, or one axis of them")
        at = instants.tolist()
        if times is not None and not at:
            raise ValueError("times is empty: leave it out for those of the film")
        try:
            path = found(self._path) if self._text is None else self._path
            native = _native.SceneRun(path, self._text, self._overrides, self._torque, _words_of(self._torque), getattr(self._torque, "__name__", ""), at)
        except Error as error:
            if self._text is None:
                raise
            raise error.without_lines_of(self._path) from None
        run = Run(native)
        _warn(native.warnings())
        return run


class Panel:
    """A run of one mechanism; arrays are views of the run's memory that cannot be written, and keep it alive."""

    def __init__(self, native: _native.SceneRun, index: int):
        self._native = native
        self._index = index

    def __repr__(self) -> str:
        title = f" {self.title!r}" if self.title else ""
        return f"<chainreel.Panel{title}: {len(self.t)} samples, {self.status}>"

    @property
    def title(self) -> str:
        """What tells it from the other panels."""
        return self._native.title(self._index)

    @property
    def status(self) -> str:
        """How it ended: "finished", "stopped" by an event or a limit, or "diverged" where the scene expects that."""
        return self._native.status(self._index)

    @property
    def t(self) -> NDArray[np.float64]:
        """(n,) sampled instants, s."""
        return self._native.t(self._index)

    @property
    def q(self) -> NDArray[np.float64]:
        """(n, nq) positions, rad or m."""
        return self._native.q(self._index)

    @property
    def qd(self) -> NDArray[np.float64]:
        """(n, nv) rates, rad/s or m/s."""
        return self._native.qd(self._index)

    @property
    def tau(self) -> NDArray[np.float64]:
        """(n, nv) torques as the run felt them, friction left out, N m or N; computed when first asked for."""
        return self._native.tau(self._index)

    @property
    def energy(self) -> NDArray[np.float64]:
        """(n,) kinetic + potential energy, and that of springs in the joints, J; computed when first asked for."""
        return self._native.energy(self._index, "total")

    @property
    def kinetic(self) -> NDArray[np.float64]:
        """(n,) kinetic energy, J."""
        return self._native.energy(self._index, "kinetic")

    @property
    def potential(self) -> NDArray[np.float64]:
        """(n,) potential energy, J; 0 where all centres of mass lie at the world's origin."""
        return self._native.energy(self._index, "potential")

    @property
    def work(self) -> NDArray[np.float64]:
        """(n,) work of torques and friction since the start, J."""
        return self._native.work(self._index)

    @property
    def energy_error(self) -> NDArray[np.float64]:
        """(n,) energy - energy[0] - work, J: 0 but for the method's error."""
        return self._native.energy(self._index, "error")

    def table(self, columns: str = "t,q,qd,qdd,tau") -> Dict[str, NDArray[np.float64]]:
        """Arrays by name, as `chainreel simulate --columns` writes them: t, q, qd, qdd, tau, energy, work, energy_error, x_G, y_G,
        z_G, xd_G, yd_G, zd_G, lambda, constraint_error, frames; (rows, ..) each, m, rad, s, N, N m, J. Samples at one instant are one row."""
        return self._native.table(columns, self._index)

    @property
    def events(self) -> List[Tuple[str, float]]:
        """What happened, and when, s."""
        return self._native.events(self._index)

    @property
    def report(self) -> Dict[str, Any]:
        """The audit, as `chainreel simulate --json` prints it: method, step, energy_error, warnings, trajectory_sha256 .."""
        return json.loads(self._native.report(self._index))


class Run(Panel):
    """What a scene did, by `Scene.run`. Its arrays are those of its only panel; of a scene that compares, see `panels`.

    A notebook shows its film.
    """

    def __init__(self, native: _native.SceneRun):
        self._native = native
        self._html: Optional[str] = None

    @property
    def _index(self) -> int:  # type: ignore[override]
        if self._native.panels > 1:
            raise Error(2, [(f"the scene compares {self._native.panels} runs: take those of run.panels, like run.panels[0].q",
                             "", 0, 0)])
        return 0

    def __repr__(self) -> str:
        return f"<chainreel.Run {self._native.name!r}: {', '.join(repr(panel) for panel in self.panels)}>"

    @property
    def panels(self) -> List[Panel]:
        """A run each of a scene that compares; else one."""
        return [Panel(self._native, index) for index in range(self._native.panels)]

    @property
    def scene(self) -> str:
        """The effective scene as YAML, every default filled in."""
        return self._native.effective_scene

    def film(self, *files: Union[str, os.PathLike], at: float = 0.0, jobs: int = 0, overwrite: bool = False) -> List[str]:
        """Writes the film, as `chainreel render -o` does, and returns the files' names.

        files: .mp4, .webm, .mov, .gif, .png, .svg, .pdf, .csv ..; single pictures show the instant `at`, s. Beside them lies what they
        say of themselves: NAME.json, NAME.txt. jobs: threads, 0 all processors. overwrite: files that stand there. Other
        threads go on; Ctrl-C leaves no half-written file.
        """
        if not files:
            raise TypeError("film takes the name of a file, like 'film.mp4'")
        made, _, notes, _, _ = self._native.film([os.fspath(file) for file in files], at, jobs, overwrite)
        _warn(notes)
        return made

    def frame(self, t: float, width: int = 0, height: int = 0) -> NDArray[np.uint8]:
        """(height, width, 4) the film's page at t, s: RGBA, opacity straight. 0: the scene's size in pixels."""
        pixels, notes = self._native.frame(t, width, height)
        _warn(notes)
        return pixels

    def picture(self, path: Union[str, os.PathLike], t: float, overwrite: bool = False) -> None:
        """The film's page at t, s, as a .png, .svg or .pdf."""
        _warn(self._native.picture(t, os.fspath(path), overwrite))

    def _repr_html_(self) -> str:
        if self._html is None:
            with tempfile.TemporaryDirectory() as folder:
                film = os.path.join(folder, "film.mp4")
                self.film(film)
                with open(film, "rb") as file:
                    data = base64.b64encode(file.read()).decode("ascii")
            self._html = ('<video controls loop muted playsinline style="max-width: 100%" width="720" '
                          f'src="data:video/mp4;base64,{data}"></video>')
        return self._html


def _warn(lines: List[str]) -> None:
    """To who called us."""
    for line in lines:
        warnings.warn(in_python(line), RunWarning, stacklevel=3)


def _with_model(scene: Mapping[str, Any]) -> Dict[str, Any]:
    """The scene with the path of a model that comes with chainreel, where it names one."""
    model = scene.get("model")
    named = isinstance(model, (str, os.PathLike))
    return {**scene, "model": found(os.fspath(model), 4)} if named else dict(scene)


def _words_of(torque: Optional[Torque]) -> str:
    """A function by its name and place."""
    if torque is None:
        return ""
    code = getattr(torque, "__code__", None)
    name = getattr(torque, "__name__", type(torque).__name__)
    return f"the Python function {name}" + (f" ({os.path.basename(code.co_filename)}:{code.co_firstlineno})" if code else "")
