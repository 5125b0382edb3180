"""A mechanism, and the terms of its equation of motion."""

from __future__ import annotations

import os
from typing import Any, List, Optional, Sequence, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _native
from ._errors import Error
from ._keys import found, overrides_of, text_of


def load(model: Union[str, os.PathLike, None] = None, *, links: Optional[Sequence[float]] = None,
         masses: Union[float, Sequence[float], None] = None, joints: Optional[str] = None, shape: Optional[str] = None,
         damping: Union[float, Sequence[float], None] = None, efforts: Union[float, Sequence[float], None] = None,
         dh: Optional[Sequence[Sequence[float]]] = None, convention: Optional[str] = None, **keys: Any) -> "Model":
    """A model from a URDF file, from a name that comes with chainreel ("rr.urdf"), or from numbers.

    links: lengths of a serial chain in m, masses in kg, joints like "RRP", shape "rod" or "point", damping in N m s/rad or
    N s/m, efforts in N m or N. In the place of links dh: a row a, alpha, d, theta of each joint (Denavit and Hartenberg; m and
    rad), convention "standard" or "modified". A number for all of masses, damping or efforts, or one each (`chainreel help scene`,
    at `model`).
    keys: what a scene says of its model: gravity=[0, -9.81, 0] (m/s^2), end_effector="tool", base="floating",
    friction=False, massless=1e-6, packages={"name": folder}.
    Throws Error, with file and line, of whatever is wrong with it.
    """
    numbers = {"links": links, "masses": masses, "joints": joints, "shape": shape, "damping": damping, "efforts": efforts,
               "dh": dh, "convention": convention}
    numbers = {key: value for key, value in numbers.items() if value is not None}
    if (model is None) == (not numbers):
        raise TypeError("load takes a file, or in its place links= (or dh=), masses=, joints=, shape=, damping=, efforts=")
    overrides = overrides_of(keys)
    if model is not None:
        return Model(_native.Model(found(os.fspath(model)), None, overrides))
    try:
        return Model(_native.Model("model", text_of({"model": numbers}), overrides))
    except Error as error:
        raise error.without_lines_of("model") from None


class Model:
    """A tree of bodies with nq positions and nv freedoms; made by `load`.

    tau = M(q) qdd + nle(q, qd) + friction(qd),  nle = C(q, qd) qd + gravity(q)

    q: nq numbers, rad or m (a floating base has x y z qx qy qz qw); qd, qdd: nv, rad/s or m/s and their rates (of a floating
    base the twist in its own axes); tau: nv, N m or N. Each result is an array of its own.
    """

    def __init__(self, native: _native.Model):
        self._native = native

    def __repr__(self) -> str:
        return f"<chainreel.Model {self.name!r}: {', '.join(self.joints)}>"

    @property
    def name(self) -> str:
        """Of the robot, as its file says."""
        return self._native.name

    @property
    def nq(self) -> int:
        """Numbers in q."""
        return self._native.nq

    @property
    def nv(self) -> int:
        """Numbers in qd, qdd and tau: the freedoms."""
        return self._native.nv

    @property
    def joints(self) -> List[str]:
        """nv names: which freedom is whose."""
        return self._native.joints

    @property
    def frames(self) -> List[str]:
        """Links, those of fixed joints too: what `frame` means below."""
        return self._native.frames

    @property
    def end_effector(self) -> Optional[str]:
        """The link that J and Lambda speak of, or None where the model has several ends: load(.., end_effector=NAME)."""
        return self._native.end_effector

    @property
    def g(self) -> NDArray[np.float64]:
        """(3,) gravity in the world, m/s^2."""
        return self._native.g

    def M(self, q: ArrayLike) -> NDArray[np.float64]:
        """(nv, nv) mass matrix, symmetric: kg m^2, kg m or kg."""
        return self._native.M(q)

    def C(self, q: ArrayLike, qd: ArrayLike) -> NDArray[np.float64]:
        """(nv, nv) matrix of Coriolis and centrifugal forces by Christoffel symbols: dM/dt - 2 C is skew."""
        return self._native.C(q, qd)

    def nle(self, q: ArrayLike, qd: ArrayLike) -> NDArray[np.float64]:
        """(nv,) C(q, qd) qd + gravity(q), N m or N."""
        return self._native.nle(q, qd)

    def gravity(self, q: ArrayLike) -> NDArray[np.float64]:
        """(nv,) tau_g: what holds the model at rest, N m or N."""
        return self._native.gravity(q)

    def friction(self, qd: ArrayLike) -> NDArray[np.float64]:
        """(nv,) tau_f of the joints' damping and friction, N m or N."""
        return self._native.friction(qd)

    def forward(self, q: ArrayLike, qd: ArrayLike, tau: ArrayLike) -> NDArray[np.float64]:
        """(nv,) qdd = M^-1 (tau - nle - friction), rad/s^2 or m/s^2."""
        return self._native.forward(q, qd, tau)

    def inverse(self, q: ArrayLike, qd: ArrayLike, qdd: ArrayLike) -> NDArray[np.float64]:
        """(nv,) tau = M qdd + nle + friction, N m or N: forward(q, qd, inverse(q, qd, qdd)) is qdd."""
        return self._native.inverse(q, qd, qdd)

    def energy(self, q: ArrayLike, qd: ArrayLike) -> "tuple[float, float]":
        """Kinetic and potential energy, J; the latter is 0 where all centres of mass lie at the world's origin."""
        return self._native.energy(q, qd)

    def position(self, q: ArrayLike, frame: Optional[str] = None) -> NDArray[np.float64]:
        """(3,) origin of a frame, or of the end effector, in the world, m."""
        return self._native.pose(q, frame)[:3, 3].copy()

    def pose(self, q: ArrayLike, frame: Optional[str] = None) -> NDArray[np.float64]:
        """(4, 4) X_WF of a frame, or of the end effector: p_W = X_WF p_F."""
        return self._native.pose(q, frame)

    def jacobian(self, q: ArrayLike, frame: Optional[str] = None, task: str = "linear") -> NDArray[np.float64]:
        """(rows, nv) J of a frame's velocity, or the end effector's: basis() @ xd = J qd, m/s.

        task "linear": x, y of a chain in the plane z = 0, else x, y, z, see `basis`; "full": angular velocity (rad/s) in front:
        3 or 6 rows.
        """
        return self._native.jacobian(q, frame, task)

    def basis(self, task: str = "linear") -> NDArray[np.float64]:
        """(rows, 3) unit vectors in the world along which the rows of J, Lambda_inv and Lambda are measured.

        Of a planar chain two in its plane, axes of the world where it holds two, the second one that nearest to up; else up and
        across. All three of others.
        """
        return self._native.basis(task)

    def Lambda_inv(self, q: ArrayLike, task: str = "linear") -> NDArray[np.float64]:
        """(rows, rows) J M^-1 J^T at the end effector, 1/kg: finite at every pose."""
        return self._native.Lambda_inv(q, task)

    def Lambda(self, q: ArrayLike, task: str = "linear") -> NDArray[np.float64]:
        """(rows, rows) effective mass (J M^-1 J^T)^-1 at the end effector, kg.

        Throws Error (code 5) at singular poses, where it is infinite: Lambda_inv is there.
        """
        return self._native.Lambda(q, task)

    def ellipse(self, q: ArrayLike, reading: str = "mass") -> "Ellipse":
        """The figure of the effective mass at the end effector, which notebooks show.

        reading "mass": forces for unit accelerations, N per m/s^2; "energy": velocities of equal kinetic energy; "belt": the
        mass felt along each direction.
        """
        return Ellipse(self, q, reading)


class Ellipse:
    """The effective mass of a model at a pose, by `Model.ellipse`; `svg` is its figure."""

    def __init__(self, model: Model, q: ArrayLike, reading: str):
        self._model = model
        self.q = np.array(q, dtype=float)
        self.reading = reading
        # 1/kg, rising: Lambda_inv's eigenvalues, (rows,), and their unit vectors, columns of (rows, rows).
        self.mobility, self.directions = model._native.mobility(self.q)
        self.svg: str = model._native.ellipse_svg(self.q, reading)

    def _repr_svg_(self) -> str:
        return self.svg

    def save(self, path: Union[str, os.PathLike], overwrite: bool = False, width: int = 640, height: int = 480) -> None:
        """Writes the figure as a .png of so many pixels, or as a .svg or .pdf of these proportions. overwrite: a file that stands there."""
        self._model._native.save_ellipse(self.q, self.reading, os.fspath(path), overwrite, width, height)
