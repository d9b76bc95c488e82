"""What other systems reach on these programs, as ratios to the same C.

Measured on 2026-11-21 on a 2-core AMD EPYC virtual machine, one after the other, with `st/` and `hand/` as they are here: ns per
scan of matiec with gcc -O2, RuSTy -O aggressive, the VM of IronPLC, and truST; hand C with gcc -O3 -march=native. As machines
differ, only the ratios to the C of that run mean something elsewhere. They are not measured again here.
"""

PEERS = ("matiec", "RuSTy", "IronPLC", "truST")
_NS: dict[str, tuple[float, float, float, float, float]] = {
    # hand C, then the peers
    "noop": (2, 1.6, 4.1, 85, 380),
    "bool": (168, 693, 588, 12_462, 169_310),
    "arith": (9_218, 20_175, 10_216, 363_298, 2_563_078),
    "array": (19_756, 64_998, 73_922, 4_056_894, 357_992_248),
    "mavg": (32, 228, 630, 25_056, 1_877_270),
    "state": (484, 596, 523, 15_943, 154_807),
    "string": (731, 3_048, 7_090, 8_611, 47_254),
}


def peer_ratios(program: str) -> dict[str, float]:
    """Ratio to hand C of each peer; empty for a program that has no C."""
    if program not in _NS:
        return {}
    c_ns, *theirs = _NS[program]
    return {peer: round(ns / c_ns, 3) for peer, ns in zip(PEERS, theirs, strict=True)}
