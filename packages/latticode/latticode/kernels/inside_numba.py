"""Faster compilation with private parts of numba: kernels optimised once, cached by content.

`compiled` uses this module for the versions of numba with which it was tested. With any other
version it uses numba's public compiler: results are bit-identical, but compilation takes several
times as long, and runs on short chains up to twice as long.

Why a kernel is optimised as one unit. numba optimises each function together with all functions
that it calls, and generates machine code for it. An inner function is thus optimised again in each
of its callers, although only the machine code of the outermost function is executed. Here, a
function called by a kernel is a subroutine: it is compiled to linkable code only, and the kernel is
optimised once, together with all its subroutines. This takes half the time. Most of a kernel is
translated by `one_pass`, so only its outermost function passes through numba's compiler.

Why references are not counted. No kernel allocates memory, but numba would count references to
every row of an array, which took half of the run on a short chain. A kernel that allocates memory
is rejected at compilation ("Only accept returning of array ...").

Why numba's own cache is not used. It identifies a function by the path and time stamp of its source
file. A copied project compiles everything again, and two processes that compile one function for
different argument types may write to the same file. `cache` stores the code instead.

This module uses these private parts of numba:
- of a dispatcher: `get_call_template` returns the types to callers, `get_overload` the key of the
  code, and `add_overload` registers a result; `load_overload`, `save_overload` and `cache_path` are
  called on its `_cache`;
- of a `CodeLibrary`: `_optimize_functions` and `_optimize_final_module` optimise, and
  `_finalize_final_module` generates machine code; `_module_pass_manager` of its `_codegen` returns
  LLVM's passes;
- of a result: `_reduce` and `_rebuild` convert it to an object that can be pickled, and back;
- the flag `no_compile` switches off machine code, and `_nrt` the counting of references.

After an upgrade of numba, tests/kernels/test_inside_numba.py fails until `compiled.TESTED` contains
the new version. Add it, run that module and tests/test_same_bits.py, and repair what fails.
"""

import pickle
from collections.abc import Callable, Iterable
from functools import cached_property
from pathlib import Path
from typing import Any

from llvmlite import binding
from numba import types
from numba.core.callconv import create_error_model
from numba.core.codegen import JITCodeLibrary
from numba.core.compiler import Compiler, CompileResult
from numba.core.registry import CPUDispatcher, cpu_target
from numba.core.serialize import dumps

from .cache import KernelFiles

OPTIONS = {
    "nopython": True,
    "error_model": "numpy",
    "nogil": True,
    "no_cfunc_wrapper": True,  # no C code calls a kernel
    "_nrt": False,
}
"""Options of all compiled functions. A function with other options must not call one that returns
an array: the caller would decrement a reference count that was never incremented."""
UNCALLED = {"no_cpython_wrapper": True}
"""Omits the code with which Python would call a function."""


def context_of_kernels() -> Any:
    """Return numba's target context with the options of all compiled functions."""
    context = cpu_target.target_context
    return context.subtarget(error_model=create_error_model(OPTIONS["error_model"], context))


class KernelLibrary(JITCodeLibrary):
    """Code of a kernel, optimised once; numba does so three times, to count fewer references."""

    def _optimize_functions(self, ll_module: Any) -> None:
        ll_module.data_layout = self._codegen._data_layout

    def _optimize_final_module(self) -> None:
        passes, builder = self._codegen._module_pass_manager()
        passes.run(self._final_module, builder)


class SubroutineLibrary(KernelLibrary):
    """Linkable code of a subroutine; it is optimised as part of the kernels that call it."""

    def _optimize_final_module(self) -> None:
        pass

    def _finalize_final_module(self) -> None:
        self._finalize_dynamic_globals()
        self._verify_declare_only_symbols()
        self._finalized = True

    def serialize_using_object_code(self) -> bytes:
        """Return the linkable code, because there is no machine code."""
        return self._get_module_for_linking().as_bitcode()

    @classmethod
    def of(cls, codegen: Any, code: bytes) -> "SubroutineLibrary":
        """Return the library restored from cached `code`."""
        library = cls(codegen, "part")
        library._final_module = binding.parse_bitcode(code)
        library._finalize_final_module()
        return library


class KernelCompiler(Compiler):
    """numba's compiler with another library."""

    LIBRARY = KernelLibrary

    def __init__(self, typing_context: Any, target_context: Any, library: Any, *more: Any) -> None:
        if not library:
            library = self.LIBRARY(target_context.codegen(), "kernel")
            library.enable_object_caching()
        super().__init__(typing_context, target_context, library, *more)


class SubroutineCompiler(KernelCompiler):
    """numba's compiler without its last stage: it stops at linkable code."""

    LIBRARY = SubroutineLibrary

    def __init__(self, *more: Any) -> None:
        super().__init__(*more)
        self.state.flags.no_compile = True


class KernelCache:
    """The cached machine code of one function, with the interface of numba's own cache."""

    ENDING = ".kernel"

    def __init__(self, function: Callable, root: Path) -> None:
        self._files = KernelFiles(function, root, self.ENDING)

    @property
    def cache_path(self) -> str:
        """The cache folder of the function's module."""
        return str(self._files.folder)

    def load_overload(self, signature: Any, target_context: Any) -> CompileResult | None:
        """Return the cached result for a signature, or None if there is none."""
        target_context.refresh()
        magic = target_context.codegen().magic_tuple()
        cached = self._files.load(signature, *_named_tuples(signature), magic)
        try:
            return None if cached is None else self.restore(target_context, cached)
        except Exception:  # unpickling a file of another numba can raise anything
            return None

    @staticmethod
    def restore(target_context: Any, cached: bytes) -> CompileResult:
        """Return the result that `save_overload` cached."""
        return CompileResult._rebuild(target_context, *pickle.loads(cached))

    def save_overload(self, signature: Any, data: CompileResult) -> None:
        """Cache a result, unless it contains addresses of this process, e.g. of a large array."""
        if not data.library.has_dynamic_globals:
            key = (signature, *_named_tuples(signature), data.codegen.magic_tuple())
            self._files.save(dumps(data._reduce()), *key)


def _named_tuples(kinds: Iterable[types.Type]) -> list[str]:
    """Return the modules and field names of all named tuples among the types, also nested ones.

    numba's type names omit them: tuples of the same name with the fields (x, y) and (y, x) would
    share code.
    """
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
    """The cached code of a subroutine."""

    ENDING = ".part"

    @staticmethod
    def restore(target_context: Any, cached: bytes) -> CompileResult:
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
    """A compiled function that may have a cache of the class `CACHE` below the folder `root`."""

    CACHE = KernelCache
    root: Path | None = None

    def keep_in(self, root: Path) -> None:
        """Load code from the cache below the folder `root`, and save new code there."""
        self.root, self._cache = root, self.CACHE(self.py_func, root)


class Subroutine(CachedFunction):
    """A function that can be called by kernels only."""

    CACHE = SubroutineCache

    def __init__(self, function: Callable, locals: dict, options: dict) -> None:
        super().__init__(function, locals, {**options, **UNCALLED}, SubroutineCompiler)

    def add_overload(self, cres: CompileResult) -> None:
        """Register the code under a new object, because it has no address."""
        cres = cres._replace(entry_point=object())
        self.targetctx.insert_user_function(cres.entry_point, cres.fndesc, [cres.library])
        self.overloads[tuple(cres.signature.args)] = cres


class Kernel(CachedFunction):
    """A function that Python can call; kernels that call it use its `subroutine`."""

    @cached_property
    def subroutine(self) -> Subroutine:
        """The same function, compiled for callers that are kernels."""
        subroutine = Subroutine(self.py_func, {}, self.targetoptions)
        if self.root:
            subroutine.keep_in(self.root)
        return subroutine

    def get_call_template(self, args: Iterable[types.Type], kws: dict) -> tuple:
        """Use one subroutine for all values of constants; numba would compile one for each."""
        return self.subroutine.get_call_template([*map(types.unliteral, args)], kws)

    def get_overload(self, sig: Any) -> Any:
        return self.subroutine.get_overload(sig)


def make_kernel(function: Callable, root: Path | None = None, **options: Any) -> Kernel:
    """Return the compiled function; its code is cached below the folder `root`, if given."""
    kernel = Kernel(function, {}, {**OPTIONS, **options}, KernelCompiler)
    if root:
        kernel.keep_in(root)
    return kernel
