"""Replaces modules that draw, so that code which imports them can be tested."""
import types
from importlib.util import spec_from_loader

DRAWING = ("IPython OpenGL bokeh glfw ipywidgets kivy matplotlib moderngl mpl_toolkits plotly pygame pyglet pylab "
           "pyqtgraph seaborn tkinter turtle vispy vpython").split()


class Nothing(types.ModuleType):
    """A module, class, function or object for drawing that does nothing, and is false."""
    __path__ = []

    def __init__(self, *values, **named):
        super().__init__(str(values[0]) if values else "nothing")

    def __getattr__(self, name):
        if name.startswith("__"):
            raise AttributeError(name)
        return Nothing(name)

    def __call__(self, *values, **named):
        return Nothing(self.__name__)

    __enter__ = __exit__ = __getitem__ = __setitem__ = __call__

    def __bool__(self):
        return False

    def __iter__(self):  # used by: figure, axes = subplots(); line, = plot(...)
        return iter([Nothing(), Nothing()] if self.__name__ == "subplots" else [Nothing()])

    def __mro_entries__(self, bases):
        return ()


class DrawingFinder:
    """An entry of sys.meta_path that replaces modules for drawing, whether they are installed or not."""
    exec_module = staticmethod(lambda module: None)
    create_module = staticmethod(lambda spec: Nothing(spec.name))

    @staticmethod
    def find_spec(name, path=None, target=None):
        return spec_from_loader(name, DrawingFinder) if name.split(".")[0] in DRAWING else None
