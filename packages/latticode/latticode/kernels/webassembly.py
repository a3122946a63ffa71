"""Kernels as WebAssembly, so that a browser computes the same bits as this machine.

numba translates a kernel to LLVM's intermediate representation, and LLVM translates that to
WebAssembly. Its arithmetic follows IEEE 754 without fused operations, so results are bit-identical.

Pointers have 8 bytes in numba's code and 4 in WebAssembly. Structures on the stack
keep their size with 8-byte pointers, because the code may clear them or address their bytes. The
optimiser runs before the pointers are converted.

No linker is needed. LLVM writes one object file, and its calls and addresses are already final. A
list of exported functions is added here, and tables for a linker are removed. `webassembly.js`
creates the memory, which begins with constants, and sets the start of the stack, which grows
downwards.
"""

import re
from pathlib import Path
from typing import Any

import numba
from llvmlite import binding

from .compiled import TESTED

TRIPLE, FEATURES = "wasm32-unknown-unknown", "+simd128,+bulk-memory,+sign-ext"
OPTIMISED = 3
WORD = 8
"""Bytes of a pointer on this machine, and of every number that numba puts on the stack."""
CUSTOM, IMPORT, EXPORT = 0, 2, 7
"""Numbers of three kinds of sections in a module."""
RESTS_ON_SIZE = re.compile(r"(load|store|getelementptr).*\{[^}]*\bptr\b")
"""Matches code that depends on the size in memory of a structure with pointers; it is rejected."""
NOT_CALLED = b"__linear_memory", b"__stack_pointer", b"__indirect_function_table"
"""Imports of a module that are not functions."""


class WebAssemblyError(RuntimeError):
    """A kernel cannot be translated to WebAssembly; the message states the reason."""


def webassembly(kernel: Any, *arguments: Any) -> bytes:
    """Return the WebAssembly module of a kernel for the types of `arguments`; it exports `run`.

    `run` has numba's calling convention: the address of the result, the address of the error
    status, then all arguments, flattened to numbers; `loader` does this. Raises WebAssemblyError
    if numba's code depends on the size of pointers or counts references.
    """
    binding.initialize_all_targets()
    binding.initialize_all_asmprinters()
    machine = binding.Target.from_triple(TRIPLE).create_target_machine(
        opt=OPTIMISED, features=FEATURES
    )
    types = tuple(map(numba.typeof, arguments))
    module = binding.parse_assembly(_code_of(kernel, types))
    functions = [symbol for symbol in module.functions if not symbol.is_declaration]
    for symbol in (
        *functions,
        *(symbol for symbol in module.global_variables if not symbol.is_declaration),
    ):
        symbol.linkage = "internal"
    run = module.get_function(kernel.subroutine.overloads[types].fndesc.mangled_name)
    run.linkage = "external"
    passes = binding.create_pass_builder(machine, binding.PipelineTuningOptions(OPTIMISED))
    passes.getModulePassManager().run(module, passes)
    small = binding.parse_assembly(_for_small_pointers(str(module), str(machine.target_data)))
    place = [symbol.name for symbol in small.functions if not symbol.is_declaration].index(run.name)
    return _exported(machine.emit_object(small), place)


def loader() -> str:
    """Return the JavaScript source of `loadKernel`, which loads a module and calls its kernel."""
    return Path(__file__).with_suffix(".js").read_text(encoding="utf-8")


def _code_of(kernel: Any, types: tuple) -> str:
    """Return LLVM's intermediate code of a kernel for these types, with all functions it calls."""
    if not hasattr(kernel, "subroutine"):
        raise WebAssemblyError(
            f"code of numba {numba.__version__} counts references, which is impossible in"
            f" WebAssembly: install numba {' or '.join(TESTED)}"
        )
    kernel.subroutine.compile(types)
    # Remove the texts of Python's exceptions, which contain paths of this machine.
    code = kernel.subroutine.inspect_llvm(types)
    return re.sub(r"ptr @\.const\.picklebuf\.[\w.]+", "ptr null", code)


def _for_small_pointers(code: str, layout: str) -> str:
    """Return the code for pointers of 4 bytes, with the stack layout of pointers of 8 bytes."""
    code = re.sub(r"target datalayout = .*", f'target datalayout = "{layout}"', code)
    code = re.sub(r"target triple = .*", f'target triple = "{TRIPLE}"', code)
    code = re.sub(r"alloca (\{.*\}|ptr)(?=[,\n])", _bytes_instead, code)
    for line in filter(RESTS_ON_SIZE.search, code.splitlines()):
        raise WebAssemblyError(f"this line depends on the size of a pointer: {line.strip()}")
    return code


def _bytes_instead(match: re.Match) -> str:
    """Return an alloca of as many bytes as the structure or pointer has on this machine."""
    words = sum(
        int(repeated or 1)
        for repeated, _ in re.findall(r"(?:\[(\d+) x )?(ptr|i64|double)\b", match[1])
    )
    return f"alloca [{WORD * words} x i8]"


def _exported(module: bytes, place: int) -> bytes:
    """Return an object file as a module that exports its function at index `place` as `run`."""
    sections, i = [], 8
    while i < len(module):
        # LLVM pads each size to 5 bytes of 7 bits (LEB128)
        size = sum((byte & 127) << 7 * k for k, byte in enumerate(module[i + 1 : i + 6]))
        sections.append(module[i : i + 6 + size])
        i += 6 + size
    (imports,) = (section for section in sections if section[0] == IMPORT)
    called = imports.count(b"\x03env") - sum(name in imports for name in NOT_CALLED)
    entry = bytes([1, 3]) + b"run" + bytes([0, called + place])
    exports = bytes([EXPORT, len(entry)]) + entry
    # sections are in the order of their numbers
    before = [section for section in sections if CUSTOM < section[0] < EXPORT]
    after = [section for section in sections if section[0] > EXPORT]
    return b"".join([module[:8], *before, exports, *after])
