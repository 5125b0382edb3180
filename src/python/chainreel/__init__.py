"""chainreel: films of robot dynamics that can be trusted.

    import chainreel as cr

    arm = cr.load("rr.urdf")              # a file, or a model that comes with chainreel
    arm.M([0.3, 1.2])                     # (nv, nv) mass matrix, kg m^2
    run = cr.Scene("rr_free").run()       # a file, a name, or a dict
    run.t, run.q, run.energy              # numpy views, without a copy
    run.film("rr.mp4")

Numbers are SI units and radians throughout. Whatever is wrong is an `Error` that names file, line and remedy; Ctrl-C is a
`KeyboardInterrupt`, and leaves no half-written file.
"""

from ._errors import Error, RunWarning
from ._model import Ellipse, Model, load
from ._native import revision, version as __version__
from ._run import Panel, Run, Scene

__all__ = ["Ellipse", "Error", "Model", "Panel", "Run", "RunWarning", "Scene", "load", "revision", "__version__"]
