#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Transcribes SLEEF's functions from this machine's library into C.

Every sine and logarithm of the program is a function of the SLEEF library that it is linked with. The engine must have the same ones,
to the last bit, but Debian installs SLEEF as x86-64 machine code only. These functions are straight arithmetic: the scalar and
two-lane instructions of SSE2, a few integer operations and jumps, and tables of constants. Each instruction is written here as a line
of C that does the same to the same registers. An instruction that is not known ends the transcription with an error.

    transcribe_sleef.py HEADER LIBRARY > sleef.c

HEADER is the file (src/elementary.cpp) that names the functions as Sleef_cinz_NAME.
"""
import bisect
import re
import subprocess
import sys

STACK = 0x7000_0000_0000  # the address of the transcribed functions' stacks, far from all constants
PRELUDE = """// Written by transcribe_sleef.py from SLEEF (Boost Software License 1.0). The statements are the library's instructions.
#include "sleef.h"
#include <stdint.h>
#include <string.h>
typedef uint64_t Q;
typedef uint32_t L;
static inline double D(Q bits) { double x; memcpy(&x, &bits, 8); return x; }
static inline Q B(double x) { Q bits; memcpy(&bits, &x, 8); return bits; }
static inline Q mask(int is) { return is ? ~(Q)0 : 0; }
static inline Q long_of(double x) { return x >= -0x1p63 && x < 0x1p63 ? (Q)(int64_t)x : (Q)1 << 63; }
static inline L int_of(double x) { return x > -2147483649.0 && x < 2147483648.0 ? (L)(int32_t)x : (L)1 << 31; }
static inline Q pair(L low, L high) { return (Q)high << 32 | low; }
static inline L half(Q low, Q high, int i) { return (L)((i & 2 ? high : low) >> (i & 1) * 32); }
static inline double maximum(double a, double b) { return a > b ? a : b; }
static inline double minimum(double a, double b) { return a < b ? a : b; }
"""
FAMILIES = {name: (f"r{name}", f"e{name}", f"{name[0]}l" if name[1] == "x" else f"{name}l") for name in
            ("ax", "bx", "cx", "dx", "si", "di", "bp", "sp")}
REGISTERS = {}  # the name of a register or of a part of it -> (whole register, bits)
for whole, double, byte in FAMILIES.values():
    REGISTERS |= {whole: (whole, 64), double: (whole, 32), byte: (whole, 8)}
for number in range(8, 16):
    REGISTERS |= {f"r{number}": (f"r{number}", 64), f"r{number}d": (f"r{number}", 32), f"r{number}b": (f"r{number}", 8)}
WHOLE = sorted({whole for whole, _ in REGISTERS.values()})
BITS = {"b": 8, "l": 32, "q": 64}
CONDITIONS = {"e": "ZF", "ne": "!ZF", "b": "CF", "ae": "!CF", "be": "(CF || ZF)", "a": "!(CF || ZF)", "p": "PF", "np": "!PF",
              "s": "SF", "ns": "!SF", "g": "(!ZF && SF == OF)", "le": "(ZF || SF != OF)", "l": "SF != OF", "ge": "SF == OF"}
COMPARISONS = {"eq": "{} == {}", "neq": "!({} == {})", "lt": "{} < {}", "nlt": "!({} < {})", "le": "{} <= {}", "nle": "!({} <= {})"}
ARITHMETIC = {"add": "{} + {}", "sub": "{} - {}", "mul": "{} * {}", "div": "{} / {}", "max": "maximum({}, {})", "min": "minimum({}, {})"}
BITWISE = {"and": "{1} & {0}", "or": "{1} | {0}", "xor": "{1} ^ {0}", "andn": "~{1} & {0}"}


class Library:
    """The machine code and the constants of a shared library."""

    def __init__(self, path):
        self.path = path
        with open(path, "rb") as file:
            self.bytes = file.read()
        headers = subprocess.run(["objdump", "-h", path], capture_output=True, text=True, check=True).stdout
        rows = re.findall(r"^\s*\d+ (\.\S+)\s+([0-9a-f]+)\s+([0-9a-f]+)\s+[0-9a-f]+\s+([0-9a-f]+)", headers, re.M)
        self.sections = [(name, int(at, 16), int(size, 16), int(offset, 16)) for name, size, at, offset in rows]
        symbols = subprocess.run(["nm", "-D", "-S", "--defined-only", path], capture_output=True, text=True, check=True).stdout
        self.symbols = {}
        for line in symbols.splitlines():
            parts = line.split()
            if len(parts) == 4:
                self.symbols[parts[3].split("@")[0]] = (int(parts[0], 16), int(parts[1], 16))
        relocations = subprocess.run(["objdump", "-R", path], capture_output=True, text=True, check=True).stdout
        self.pointers = {int(at, 16): name.split("@")[0] for at, name in
                         re.findall(r"^([0-9a-f]+) R_X86_64_GLOB_DAT\s+(\S+)", relocations, re.M)}

    def constant(self, address, size):
        """A number of `size` bytes that lies among the constants; the address of an object for a place of the linker's."""
        if address in self.pointers:
            return self.symbols[self.pointers[address]][0]
        for name, at, length, offset in self.sections:
            if at <= address and address + size <= at + length and name in (".rodata", ".data.rel.ro"):
                return int.from_bytes(self.bytes[offset + address - at : offset + address - at + size], "little")
        raise SystemExit(f"transcribe_sleef.py: {address:#x} is no constant of {self.path}")

    def tables(self, addresses):
        """Begin and end of the tables at these addresses. A table ends where another instruction of the library finds something."""
        code = subprocess.run(["objdump", "-d", "--no-show-raw-insn", self.path], capture_output=True, text=True, check=True).stdout
        known = sorted({int(at, 16) for at in re.findall(r"# ([0-9a-f]+) <", code)})
        found = []
        for start in sorted(addresses):
            end = known[bisect.bisect_right(known, start)]
            if found and found[-1][1] == start:
                found[-1] = (found[-1][0], end)
            else:
                found.append((start, end))
        return found

    def section(self, address):
        return next(name for name, at, size, _ in self.sections if at <= address < at + size)

    def next_symbol(self, address):
        return min(at for at, _ in self.symbols.values() if at > address)

    def instructions(self, start, end):
        """Address, mnemonic and operands of the instructions from `start` to `end`."""
        text = subprocess.run(["objdump", "-d", "-M", "suffix", "--no-show-raw-insn", f"--start-address={start}",
                               f"--stop-address={end}", self.path], capture_output=True, text=True, check=True).stdout
        for at, mnemonic, operands in re.findall(r"^\s+([0-9a-f]+):\t(\S+)[ ]*([^\n]*)$", text, re.M):
            absolute = re.search(r"# ([0-9a-f]+) <", operands)
            operands = re.sub(r"\s*(#|<).*", "", operands)
            if absolute:
                operands = re.sub(r"-?(0x[0-9a-f]+)?\(%rip\)", f"@{absolute[1]}", operands)
            yield int(at, 16), mnemonic, re.findall(r"(?:[^,(]|\([^)]*\))+", operands)


class Transcript:
    """The C statements of one function."""

    def __init__(self, library, name):
        self.library, self.name, self.lines, self.tables = library, name, [], set()
        self.callee = self.end = None
        start, size = library.symbols[name]
        self.code(start, start + size)
        if self.callee:
            self.end = "rsp += 8; goto returned;"
            self.code(self.callee, library.next_symbol(self.callee))
        targets = {int(target, 16) for line in self.lines for target in re.findall(r"goto a([0-9a-f]+)", line)}
        if targets - {int(line[1:-2], 16) for line in self.lines if line.startswith("a")}:
            raise SystemExit(f"transcribe_sleef.py: {name} jumps out of itself")
        self.lines = [line for line in self.lines if not line.startswith("a") or int(line[1:-2], 16) in targets]

    def code(self, start, end):
        for at, mnemonic, operands in self.library.instructions(start, end):
            self.here, self.mnemonic, self.operands = at, mnemonic, operands
            self.lines.append(f"a{at:x}:;")
            self.instruction(mnemonic, *operands)

    def fail(self):
        raise SystemExit(f"transcribe_sleef.py: {self.name}, {self.here:x}: unknown: {self.mnemonic} {', '.join(self.operands)}")

    def put(self, statement):
        self.lines.append(statement)

    # Operands

    def address(self, operand):
        if operand.startswith("@"):
            return f"{int(operand[1:], 16):#x}u"
        found = re.fullmatch(r"(-?0x[0-9a-f]+)?\((%\w+)?(?:,(%\w+),(\d))?\)", operand) or self.fail()
        displacement, base, index, scale = found.groups()
        parts = [REGISTERS[base[1:]][0]] if base else []
        parts += [f"{REGISTERS[index[1:]][0]} * {scale}"] if index else []
        return " + ".join(parts + [f"(Q){int(displacement, 16)}"] if displacement else parts)

    def load(self, operand, bits):
        """A number of 32 or 64 bits at a place in memory."""
        if operand.startswith("%fs:"):
            return "0"  # the guard of the stack
        if operand.startswith("@"):
            return f"{self.library.constant(int(operand[1:], 16), bits // 8):#x}u" + "ll" * (bits == 64)
        return f"load{bits}(stack, {self.address(operand)})"

    def number(self, operand, bits):
        """An integer operand."""
        if operand.startswith("$"):
            return f"(Q){int(operand[1:], 16) & (1 << bits) - 1:#x}ull"
        if operand.startswith("%") and operand[1:] in REGISTERS:
            whole, _ = REGISTERS[operand[1:]]
            return whole if bits == 64 else f"({whole} & {(1 << bits) - 1:#x}u)"
        return self.load(operand, bits)

    def set(self, operand, value, bits):
        if not operand.startswith("%"):
            return self.put(f"store(stack, {self.address(operand)}, {value}, {bits // 8});")
        whole, _ = REGISTERS[operand[1:]]
        if bits == 8:
            return self.put(f"{whole} = ({whole} & ~(Q)255) | ((Q)({value}) & 255);")
        return self.put(f"{whole} = {value};" if bits == 64 else f"{whole} = (L)({value});")

    @staticmethod
    def is_vector(operand):
        return operand.startswith("%xmm")

    def vector(self, operand):
        """Both halves of an operand of 128 bits."""
        if self.is_vector(operand):
            return f"x{operand[4:]}l", f"x{operand[4:]}h"
        if operand.startswith("@"):
            at = int(operand[1:], 16)
            return tuple(f"{self.library.constant(at + i, 8):#x}ull" for i in (0, 8))
        return tuple(f"load64(stack, {self.address(operand)} + {i})" for i in (0, 8))

    def low(self, operand):
        """The lower half, of which memory has no more."""
        return self.vector(operand)[0] if self.is_vector(operand) else self.load(operand, 64)

    def assign(self, operand, low, high):
        low_name, high_name = self.vector(operand)
        self.put(f"{{ const Q low = {low}, high = {high}; {low_name} = low; {high_name} = high; }}")

    # Instructions

    def instruction(self, name, *operands):
        if name in ("nop", "nopw", "nopl", "data16", "cs", "xchgw", "xchg"):
            return None
        if re.fullmatch(r"retq?", name):
            return self.put(self.end or "goto end;")
        if re.fullmatch(r"callq?", name):
            return self.call(int(operands[0], 16))
        if re.fullmatch(r"jmpq?", name):
            return self.put(f"goto a{operands[0]};")
        if name[0] == "j" and name[1:] in CONDITIONS:
            return self.put(f"if ({CONDITIONS[name[1:]]}) goto a{operands[0]};")
        if name[:3] == "set" and name[3:] in CONDITIONS:
            return self.set(operands[0], CONDITIONS[name[3:]], 8)
        if found := re.fullmatch(r"cmov(\w+?)([lq])", name):
            return self.conditional_move(*found.groups(), *operands)
        if any(self.is_vector(operand) for operand in operands):
            return self.vector_instruction(name, *operands)
        return self.integer_instruction(name, *operands)

    def call(self, target):
        """One call of a function without a name; any other function reports a broken stack."""
        if self.library.section(target).startswith(".plt"):
            return self.put("__builtin_trap();")
        if self.callee or self.end:
            return self.fail()
        self.callee = target
        return self.put(f"rsp -= 8; goto a{target:x}; returned:;")

    def conditional_move(self, condition, size, source, target):
        bits = BITS[size]
        condition = CONDITIONS.get(condition) or self.fail()
        self.set(target, f"{condition} ? {self.number(source, bits)} : {self.number(target, bits)}", bits)

    def integer_instruction(self, name, *operands):
        found = re.fullmatch(r"(movabs|movzb|mov|lea|and|or|xor|add|sub|cmp|test|shl|shr|sar|neg|not|push|pop)([blq])", name) or self.fail()
        kind, bits = found[1], BITS[found[2]]
        target = operands[-1]
        source = operands[0] if len(operands) > 1 else "$0x1"  # a shift by 1
        if kind == "push":
            self.put("rsp -= 8;")
            return self.put(f"store(stack, rsp, {self.number(target, 64)}, 8);")
        if kind == "pop":
            self.set(target, "load64(stack, rsp)", 64)
            return self.put("rsp += 8;")
        if kind == "lea":
            if source.startswith("@"):
                self.tables.add(int(source[1:], 16))
            return self.set(target, self.address(source), bits)
        if kind in ("mov", "movabs"):
            if source.startswith("@") and int(source[1:], 16) in self.library.pointers:
                self.tables.add(self.library.constant(int(source[1:], 16), 8))
            return self.set(target, self.number(source, bits), bits)
        if kind == "movzb":
            return self.set(target, self.number(source, 8), bits)
        if kind == "not":
            return self.set(target, f"~{self.number(target, bits)}", bits)
        a, b, top = self.number(target, bits), self.number(source, bits), bits - 1
        if kind == "neg":
            value = f"0 - {a}"
        elif kind == "sar":
            value = f"(Q)((int{bits}_t){a} >> {b})"
        else:
            operator = {"and": "&", "test": "&", "or": "|", "xor": "^", "add": "+", "sub": "-", "cmp": "-", "shl": "<<", "shr": ">>"}
            value = f"{a} {operator[kind]} {b}"
        self.put(f"{{ const Q a = {a}, b = {b}, c = ({value}) & {(1 << bits) - 1:#x}ull; (void)a, (void)b;")
        if kind in ("sub", "cmp"):
            self.put(f"CF = a < b; OF = ((a ^ b) & (a ^ c)) >> {top} & 1;")
        elif kind == "add":
            self.put(f"CF = c < a; OF = (~(a ^ b) & (a ^ c)) >> {top} & 1;")
        elif kind in ("and", "test", "or", "xor"):
            self.put("CF = OF = 0;")
        self.put(f"ZF = c == 0; SF = (int)(c >> {top} & 1);")
        if kind not in ("cmp", "test"):
            self.set(target, "c", bits)
        return self.put("}")

    def vector_instruction(self, name, *operands):
        source, target = operands[-2], operands[-1]
        if name in ("movapd", "movaps", "movdqa", "movupd", "movsd", "movq", "movd", "movhpd", "movlpd", "movhlps", "movmskpd"):
            return self.move(name, source, target)
        if name == "ucomisd":
            return self.put(f"{{ const double a = D({self.low(target)}), b = D({self.low(source)}); PF = a != a || b != b; "
                            "CF = PF || a < b; ZF = PF || a == b; OF = SF = 0; }")
        if name.startswith("cvt"):
            return self.convert(name, source, target)
        t_low, t_high = self.vector(target)
        if found := re.fullmatch(r"cmp(\w+?)(sd|pd)", name):
            s = (self.low(source), "0") if found[2] == "sd" else self.vector(source)
            return self.lanes(found[2], target, lambda i: f"mask({self.comparison(found[1], (t_low, t_high)[i], s[i])})")
        if (found := re.fullmatch(r"(add|sub|mul|div|max|min)(sd|pd)", name)):
            s = (self.low(source), "0") if found[2] == "sd" else self.vector(source)
            return self.lanes(found[2], target,
                              lambda i: f"B({ARITHMETIC[found[1]].format(f'D({(t_low, t_high)[i]})', f'D({s[i]})')})")
        if found := re.fullmatch(r"sqrt(sd|pd)", name):
            s = (self.low(source), "0") if found[1] == "sd" else self.vector(source)
            return self.lanes(found[1], target, lambda i: f"B(__builtin_sqrt(D({s[i]})))")
        if found := re.fullmatch(r"p(andn|and|or|xor)|(andn|and|or|xor)p[sd]", name):
            s = self.vector(source)
            operation = BITWISE[found[1] or found[2]]
            return self.assign(target, operation.format(s[0], t_low), operation.format(s[1], t_high))
        return self.shuffle(name, operands, target)

    def lanes(self, kind, target, value):
        """Sets the lower half of a register, or both."""
        self.assign(target, value(0), value(1) if kind == "pd" else self.vector(target)[1])

    def comparison(self, kind, a, b):
        if kind in ("unord", "ord"):
            return f"{'!' * (kind == 'ord')}(D({a}) != D({a}) || D({b}) != D({b}))"
        return COMPARISONS[kind].format(f"D({a})", f"D({b})") if kind in COMPARISONS else self.fail()

    def move(self, name, source, target):
        if name == "movmskpd":
            low, high = self.vector(source)
            return self.set(target, f"{low} >> 63 | {high} >> 63 << 1", 32)
        if not self.is_vector(target):
            low, high = self.vector(source)
            if name in ("movq", "movsd", "movlpd"):
                return self.set(target, low, 64)
            if name in ("movd", "movhpd"):
                return self.set(target, low if name == "movd" else high, 32 if name == "movd" else 64)
            address = self.address(target)
            return self.put(f"store(stack, {address}, {low}, 8); store(stack, {address} + 8, {high}, 8);")
        t_low, t_high = self.vector(target)
        if name == "movhlps":
            return self.assign(target, self.vector(source)[1], t_high)
        if name in ("movhpd", "movlpd"):
            loaded = self.load(source, 64)
            return self.assign(target, *((t_low, loaded) if name == "movhpd" else (loaded, t_high)))
        if name == "movsd":
            return self.assign(target, self.low(source), t_high if self.is_vector(source) else "0")
        if name in ("movq", "movd"):
            bits = 64 if name == "movq" else 32
            return self.assign(target, self.vector(source)[0] if self.is_vector(source) else self.number(source, bits), "0")
        return self.assign(target, *self.vector(source))

    def convert(self, name, source, target):
        if name == "cvttsd2si":
            bits = REGISTERS[target[1:]][1]
            return self.set(target, f"{'long_of' if bits == 64 else 'int_of'}(D({self.low(source)}))", bits)
        if name == "cvtsi2sdl":
            return self.assign(target, f"B((double)(int32_t){self.number(source, 32)})", self.vector(target)[1])
        low, high = self.vector(source)
        if name == "cvttpd2dq":
            return self.assign(target, f"pair(int_of(D({low})), int_of(D({high})))", "0")
        if name == "cvtdq2pd":
            return self.assign(target, f"B((double)(int32_t)({low}))", f"B((double)(int32_t)({low} >> 32))")
        return self.fail()

    def shuffle(self, name, operands, target):
        immediate = int(operands[0][1:], 16) if operands[0].startswith("$") else 0
        t = self.vector(target)
        if name == "psllq":
            return self.assign(target, f"{t[0]} << {immediate}", f"{t[1]} << {immediate}")
        s = self.vector(operands[-2])
        if name == "shufpd":
            return self.assign(target, t[immediate & 1], s[immediate >> 1 & 1])
        if name in ("unpcklpd", "punpcklqdq"):
            return self.assign(target, t[0], s[0])
        if name in ("unpckhpd", "punpckhqdq"):
            return self.assign(target, t[1], s[1])
        if name == "pshufd":
            parts = [f"half({s[0]}, {s[1]}, {immediate >> 2 * i & 3})" for i in range(4)]
            return self.assign(target, f"pair({parts[0]}, {parts[1]})", f"pair({parts[2]}, {parts[3]})")
        if name == "paddd":
            sums = [f"(L){t[i]} + (L){s[i]}, (L)({t[i]} >> 32) + (L)({s[i]} >> 32)" for i in (0, 1)]
            return self.assign(target, f"pair({sums[0]})", f"pair({sums[1]})")
        return self.fail()

    def text(self):
        is_pair, has_two = "sincos" in self.name, "atan2" in self.name or "pow" in self.name
        registers = ", ".join(f"{name} = 0" for name in WHOLE if name != "rsp")
        vectors = ", ".join(f"x{i}l = 0, x{i}h = 0" for i in range(16))
        given = "x0l = B(x);" + (" x1l = B(y);" if has_two else "")
        result = "return (Sleef_double_2){D(x0l), D(x1l)};" if is_pair else "return D(x0l);"
        return "\n".join([
            f"{'Sleef_double_2' if is_pair else 'double'} {self.name}(double x{', double y' if has_two else ''}) {{",
            f"Q stack[128], {registers}, rsp = {STACK + 896:#x}ull, {vectors};", "int ZF = 0, CF = 0, SF = 0, OF = 0, PF = 0;",
            "(void)stack, (void)ZF, (void)CF, (void)SF, (void)OF, (void)PF;", given, *self.lines, "end:;", result, "}\n"])


def table_code(library, addresses):
    """The tables of constants and the functions that read and write memory."""
    texts, reads = [], []
    for start, end in library.tables(addresses):
        numbers = [library.constant(at, 8) for at in range(start, end, 8)]
        texts.append(f"static const Q table_{start:x}[] = {{{', '.join(f'{number:#x}ull' for number in numbers)}}};")
        reads.append(f"if (at - {start:#x}u < sizeof table_{start:x}) "
                     f"return memcpy(&value, (const char*)table_{start:x} + (at - {start:#x}u), 8), value;")
    return "\n".join(texts + [
        "static inline Q load64(const Q* stack, Q at) {", "Q value = 0;",
        f"if (at >= {STACK:#x}ull) return memcpy(&value, (const char*)stack + (at - {STACK:#x}ull), 8), value;", *reads,
        "__builtin_trap();", "}",
        "static inline Q load32(const Q* stack, Q at) { return (L)load64(stack, at); }",
        "static inline void store(Q* stack, Q at, Q value, int size) {",
        f"memcpy((char*)stack + (at - {STACK:#x}ull), &value, (unsigned)size);", "}\n"])


def main():
    source, path = sys.argv[1:]
    with open(source, encoding="utf-8") as file:
        names = sorted(set(re.findall(r"Sleef_cinz_\w+", file.read())))
    library = Library(path)
    transcripts = [Transcript(library, name) for name in names]
    tables = set().union(*(transcript.tables for transcript in transcripts))
    print(PRELUDE + table_code(library, tables) + "\n".join(transcript.text() for transcript in transcripts))


if __name__ == "__main__":
    main()
