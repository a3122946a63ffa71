"""All that this project does inside numba: kernels compiled as a whole, and kept by their content.

`compiled` uses this module for the versions of numba that it was tested with. With any other it
uses what numba offers to all: the same bits, but twice the time to compile, and runs on short
chains take up to twice as long too.

Why a kernel is compiled as a whole. numba compiles each function for itself: LLVM optimises its
code together with that of all that it calls, and turns the result into machine code. So a function
at the bottom is optimised again in each of its callers, and nobody runs the machine code of any but
the outermost. Here a function that a kernel calls is a part. It is compiled to code that can be
linked and no further, and the kernel is optimised once, together with all its parts. That takes
half of the time.

Why no references are counted. No kernel allocates memory. numba would all the same count up and
down for every row of an array that a kernel looks at, which took half of a run on a short chain. A
kernel that asks for memory is refused when it is compiled ("Only accept returning of array ...").

Why numba's own cache is not used. It names what it keeps after the path and the time stamp of a
source file: a copied project compiles everything again, and two processes that compile one function
for two types of arguments at once may write both to the same file. `kernel_cache` keeps it instead.

What this rests upon, all of it private to numba:
- a dispatcher tells callers its types in `get_call_template` and the key of its code in
  `get_overload`, keeps a result in `add_overload`, and asks its `_cache` for
  `load_overload`, `save_overload` and `cache_path`;
- a `CodeLibrary` optimises in `_optimize_final_module`, makes machine code in
  `_finalize_final_module`, and `_reduce` and `_rebuild` turn a result into bytes and back;
- the flag `no_compile` asks for no machine code, and `_nrt` switches the counting of references;

When numba is upgraded, tests/kernels/test_inside_numba.py fails until its version stands in
`compiled.TESTED`. Put it there, run that module and tests/test_same_bits.py, and mend what breaks.
"""

import pickle
from collections.abc import Callable
from functools import cached_property
from pathlib import Path

from llvmlite import binding
from numba import types
from numba.core.codegen import JITCodeLibrary
from numba.core.compiler import Compiler, CompileResult
from numba.core.registry import CPUDispatcher
from numba.core.serialize import dumps

from .cache import KernelFiles

OPTIONS = {
    "nopython": True,
    "error_model": "numpy",
    "nogil": True,
    "no_cfunc_wrapper": True,  # no C code calls a kernel
    "_nrt": False,
}
"""What all compiled functions share. No function of another kind may call one that returns an
array: it would count a reference down that was never counted up."""
UNCALLED = {"no_cpython_wrapper": True}
"""Leaves out the code by which Python would call a function."""


class SubroutineLibrary(JITCodeLibrary):
    """Code that is linked into kernels, and is optimised there and not here."""

    def _optimize_final_module(self) -> None:
        pass

    def _finalize_final_module(self) -> None:
        self._finalize_dynamic_globals()
        self._verify_declare_only_symbols()
        self._finalized = True

    def serialize_using_object_code(self) -> bytes:
        """Return the code itself, as there is no machine code."""
        return self._get_module_for_linking().as_bitcode()

    @classmethod
    def of(cls, codegen, code: bytes) -> "SubroutineLibrary":
        """Return the library that was kept as `code`."""
        library = cls(codegen, "part")
        library._final_module = binding.parse_bitcode(code)
        library._finalize_final_module()
        return library


class SubroutineCompiler(Compiler):
    """The stages of numba up to code that can be linked."""

    def __init__(self, typing_context, target_context, library, *more):
        library = library or SubroutineLibrary(target_context.codegen(), "part")
        super().__init__(typing_context, target_context, library, *more)
        self.state.flags.no_compile = True


class KernelCache:
    """The machine code of one function, in the form that a dispatcher asks for."""

    ENDING = ".kernel"

    def __init__(self, function: Callable, root: Path):
        self._files = KernelFiles(function, root, self.ENDING)

    @property
    def cache_path(self) -> str:
        """The folder of the machine code of this module."""
        return str(self._files.folder)

    def load_overload(self, signature, target_context) -> CompileResult | None:
        """Return the machine code for these types of arguments, or None where there is none."""
        target_context.refresh()
        magic = target_context.codegen().magic_tuple()
        cached = self._files.load(signature, *_named_tuples(signature), magic)
        try:
            return None if cached is None else self.restore(target_context, cached)
        except Exception:  # whatever unpickling raises: this is nothing that this numba kept
            return None

    @staticmethod
    def restore(target_context, cached: bytes) -> CompileResult:
        """Return what `save_overload` kept."""
        return CompileResult._rebuild(target_context, *pickle.loads(cached))

    def save_overload(self, signature, data: CompileResult) -> None:
        """Keep machine code, unless it holds addresses of this process, as of a large array."""
        if not data.library.has_dynamic_globals:
            key = (signature, *_named_tuples(signature), data.codegen.magic_tuple())
            self._files.save(dumps(data._reduce()), *key)


def _named_tuples(kinds) -> list[str]:
    """Return what numba's words for types leave out of named tuples, at any depth: where the class
    is defined, and its fields. Without them (x, y) and (y, x) of one name would share code."""
    names = []
    for kind in kinds:
        if isinstance(kind, types.BaseNamedTuple):
            tuple_class = kind.instance_class
            names.append(
                f"{tuple_class.__module__}.{tuple_class.__qualname__}({', '.join(kind.fields)})"
            )
        names += _named_tuples(kind) if isinstance(kind, types.BaseTuple) else []
    return names


class SubroutineCache(KernelCache):
    """The code of a part, kept as that of a kernel is."""

    ENDING = ".part"

    @staticmethod
    def restore(target_context, cached: bytes) -> CompileResult:
        code, descriptor, environment, signature, *_ = pickle.loads(cached)
        return CompileResult(
            typing_context=target_context.typing_context,
            target_context=target_context,
            entry_point=None,
            typing_error=None,
            type_annotation=None,
            signature=signature,
            objectmode=False,
            lifted=(),
            fndesc=descriptor,
            library=SubroutineLibrary.of(target_context.codegen(), code),
            call_helper=None,
            environment=environment,
            metadata=None,
            reload_init=[],
            referenced_envs=(),
        )


class CachedFunction(CPUDispatcher):
    """A compiled function whose code may be kept in a folder, in the way of `CACHE`."""

    CACHE = KernelCache
    root = None

    def keep_in(self, root: Path) -> None:
        """Keep code below the folder `root`, and take from it what is there."""
        self.root, self._cache = root, self.CACHE(self.py_func, root)


class Subroutine(CachedFunction):
    """A function as kernels call it."""

    CACHE = SubroutineCache

    def __init__(self, function: Callable, locals=None, options=None):
        super().__init__(function, locals, {**options, **UNCALLED}, SubroutineCompiler)

    def add_overload(self, cres: CompileResult) -> None:
        """Let callers find the code by a key of its own: it has no address."""
        cres = cres._replace(entry_point=object())
        self.targetctx.insert_user_function(cres.entry_point, cres.fndesc, [cres.library])
        self.overloads[tuple(cres.signature.args)] = cres


class Kernel(CachedFunction):
    """A function as Python calls it; kernels that call it compile it as a part of theirs."""

    @cached_property
    def subroutine(self) -> Subroutine:
        subroutine = Subroutine(self.py_func, {}, self.targetoptions)
        if self.root:
            subroutine.keep_in(self.root)
        return subroutine

    def get_call_template(self, args, kws):
        """Let one part serve all values of its arguments: numba compiles one for each constant."""
        return self.subroutine.get_call_template([*map(types.unliteral, args)], kws)

    def get_overload(self, sig):
        return self.subroutine.get_overload(sig)


def make_kernel(function: Callable, root: Path | None = None, **options) -> Kernel:
    """Return the compiled function, whose code is kept below the folder `root` if there is one."""
    kernel = Kernel(function, {}, {**OPTIONS, **options})
    if root:
        kernel.keep_in(root)
    return kernel
