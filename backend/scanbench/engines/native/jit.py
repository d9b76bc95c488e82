"""Text of LLVM IR -> machine code in this process. The only module that knows llvmlite."""

import ctypes
import ctypes.util
import hashlib
import threading
from collections.abc import Iterable
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from time import perf_counter_ns

import llvmlite
import llvmlite.binding as llvm

from scanbench.engines.native import emit_loop
from scanbench.engines.native.emit_intrinsics import LIBM, LIBM_PREFIX

_ready = False
_loop: "Code | None" = None
"""What runs the scans of every program; there as soon as one is linked."""
_making_loop = threading.Lock()


@dataclass(slots=True)
class Timings:
    """Milliseconds that the steps of a build took; 0 for what was made unnecessary by what is kept."""

    emit: float = 0.0
    parse: float = 0.0
    optimise: float = 0.0
    codegen: float = 0.0
    link: float = 0.0


class Code:
    """Machine code in memory; freed by `close`, or with the last reference to it."""

    def __init__(self, engine: "llvm.ExecutionEngine") -> None:
        self._engine = engine

    def function(self, name: str) -> int:
        """Address of an exported function."""
        return int(self._engine.get_function_address(name))

    def variable(self, name: str) -> int:
        """Address of an exported variable."""
        return int(self._engine.get_global_value_address(name))

    def close(self) -> None:
        """Frees the code; nobody may run it any more."""
        self._engine.close()


def _prepare() -> None:
    global _ready
    if _ready:
        return
    llvm.initialize_native_target()
    llvm.initialize_native_asmprinter()
    # under names of ours: LLVM would replace a `pow` or `sin` that it knows by something that rounds differently
    libm = ctypes.CDLL(ctypes.util.find_library("m") or None)
    for name in LIBM.values():
        llvm.add_symbol(LIBM_PREFIX + name, ctypes.cast(getattr(libm, name), ctypes.c_void_p).value)
    _ready = True


def loop() -> Code:
    """The code of `emit_loop`, made once a process, whichever thread comes first; a process that only compiles needs none."""
    global _loop
    if _loop is None:
        with _making_loop:
            if _loop is None:
                made = _linked([compile_object(emit_loop.module(), 2, Timings())], Timings())
                llvm.add_symbol(emit_loop.FORCES_NAME, made.function(emit_loop.FORCES_NAME))
                _loop = made
    return _loop


def _machine(opt_level: int) -> "llvm.TargetMachine":
    """A new one each time: an execution engine takes it over."""
    target = llvm.Target.from_default_triple()
    return target.create_target_machine(
        cpu=llvm.get_host_cpu_name(), features=llvm.get_host_cpu_features().flatten(), opt=opt_level, jit=True
    )


LOGIC = 12
"""A module with an operation of BOOLs in each so many lines is logic."""


def _is_logic(ir: str) -> bool:
    """Whether BOOLs are most of what a module computes. Joined into vectors they are slower, as each has to be put into its bit and taken
    out: 500 rungs take 1.21 us a scan with vectors and 0.88 without. Strings and numbers are 1.1 to 1.2 times as fast with them."""
    return LOGIC * (ir.count(" and i1 ") + ir.count(" or i1 ")) > ir.count("\n")


def _optimised(ir: str, machine: "llvm.TargetMachine", opt_level: int, timings: Timings) -> "llvm.ModuleRef":
    start = perf_counter_ns()
    # a context of its own: what is in the global one is never freed
    module = llvm.parse_assembly(ir, llvm.create_context())
    module.triple = llvm.get_process_triple()
    module.data_layout = str(machine.target_data)
    module.verify()
    timings.parse += (perf_counter_ns() - start) / 1e6
    start = perf_counter_ns()
    if opt_level > 0:
        options = llvm.create_pipeline_tuning_options(speed_level=opt_level)
        options.loop_vectorization = options.loop_unrolling = True
        options.slp_vectorization = not _is_logic(ir)
        builder = llvm.create_pass_builder(machine, options)
        builder.getModulePassManager().run(module, builder)
    timings.optimise += (perf_counter_ns() - start) / 1e6
    return module


def optimised_text(ir: str, opt_level: int = 2) -> str:
    """The module after LLVM's passes, to be looked at."""
    _prepare()
    return str(_optimised(ir, _machine(opt_level), opt_level, Timings()))


def assembly(ir: str, opt_level: int = 2) -> str:
    """The machine code as assembly, to be looked at."""
    _prepare()
    machine = _machine(opt_level)
    return str(machine.emit_assembly(_optimised(ir, machine, opt_level, Timings())))


def compile_object(ir: str, opt_level: int, timings: Timings) -> bytes:
    """Object code of a module."""
    _prepare()
    machine = _machine(opt_level)
    module = _optimised(ir, machine, opt_level, timings)
    start = perf_counter_ns()
    code = bytes(machine.emit_object(module))
    timings.codegen += (perf_counter_ns() - start) / 1e6
    return code


@cache
def host() -> str:
    """Everything but the text that object code depends on."""
    _prepare()
    version = f"{llvmlite.__version__} {llvm.llvm_version_info} {llvm.get_process_triple()}"
    own = hashlib.sha256(Path(__file__).read_bytes()).hexdigest()  # how it is called
    return f"{version} {llvm.get_host_cpu_name()} {llvm.get_host_cpu_features().flatten()} {own}"


def object_key(ir: str, opt_level: int) -> str:
    """Under which the object code of a module is kept."""
    return hashlib.sha256(f"{host()} {opt_level}\n{ir}".encode()).hexdigest()


def link(codes: Iterable[bytes], timings: Timings) -> Code:
    """Loads object code into the process; its parts may call each other, and what the loop has for them."""
    loop()
    return _linked(codes, timings)


def _linked(codes: Iterable[bytes], timings: Timings) -> Code:
    start = perf_counter_ns()
    empty = llvm.parse_assembly("")
    empty.triple = llvm.get_process_triple()
    engine = llvm.create_mcjit_compiler(empty, _machine(0))
    for code in codes:
        engine.add_object_file(llvm.ObjectFileRef.from_data(code))
    engine.finalize_object()
    timings.link += (perf_counter_ns() - start) / 1e6
    return Code(engine)
