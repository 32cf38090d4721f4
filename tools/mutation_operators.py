"""Small faults for C++ text: what a slip of the pen would write instead.

`mutants(path, text)` gives every fault of every line of code. It reads tokens, not the language, and relies on the project's
format: a binary operator stands between blanks, the bracket of a template does not.
"""

import re
from dataclasses import dataclass

TOKEN = re.compile(
    r"""(?P<comment>//[^\n]*|/\*.*?\*/)
      | (?P<text>"(?:\\.|[^"\\])*"|'(?:\\.|[^'\\])+')
      | (?P<line>^[ \t]*\#(?:\\\n|[^\n])*)
      | (?P<attribute>\[\[.*?\]\])
      | (?P<number>\.?\d(?:[eEpP][+-]|'\d|[\w.])*)
      | (?P<word>[A-Za-z_]\w*)
      | (?P<operator><=>|<<=|>>=|\.\.\.|->|::|\+\+|--|<<|>>|<=|>=|==|!=|&&|\|\||[-+*/%&|^]=|[-+*/%&|^~!<>=?:;,.(){}\[\]])
      | (?P<blank>\s+)""",
    re.VERBOSE | re.MULTILINE | re.DOTALL,
)

# A binary operator and what may stand there by mistake: the boundary moved, the sense turned round.
BINARY = {
    "<": ("<=", ">="), "<=": ("<", ">"), ">": (">=", "<="), ">=": (">", "<"), "==": ("!=",), "!=": ("==",),
    "+": ("-",), "-": ("+",), "*": ("/",), "/": ("*",), "%": ("*",),
    "&&": ("||",), "||": ("&&",), "&": ("|",), "|": ("&",), "<<": (">>",), ">>": ("<<",),
    "+=": ("-=", "="), "-=": ("+=", "="), "*=": ("/=", "="), "/=": ("*=",), "%=": ("=",), "|=": ("=", "&="), "&=": ("=", "|="),
}
# Stands for the text that is changed.
WHOLE = "\0"
UNARY_REMOVED = ("-", "!", "~")
# Statements that begin with these are declarations: without them nothing compiles.
NOT_DELETED = {
    "auto", "case", "const", "constexpr", "default", "else", "enum", "for", "friend", "if", "namespace", "private", "public",
    "static", "static_assert", "struct", "switch", "template", "using", "while", "class", "inline", "do",
}


@dataclass(frozen=True)
class Token:
    kind: str
    text: str
    start: int

    @property
    def end(self):
        return self.start + len(self.text)


@dataclass(frozen=True)
class Mutant:
    """`change` and `nth`, the how-manieth of its kind in the line, find it again when lines move."""

    path: str
    function: str
    line: str
    change: str
    nth: int
    number: int  # of the line, for people
    text: str  # of the whole mutated file

    @property
    def key(self):
        return (self.path, self.function, self.line, self.change, self.nth)

    def __str__(self):
        nth = f" (number {self.nth} in the line)" if self.nth > 1 else ""
        return f"{self.path}:{self.number}: {self.change}{nth}   in {self.function}: {self.line}"


def tokens_of(text):
    """Tokens of code: no comments, strings, attributes, preprocessor lines or static_asserts."""
    tokens = [Token(m.lastgroup, m.group(), m.start()) for m in TOKEN.finditer(text)]
    code = [t for t in tokens if t.kind in ("number", "word", "operator")]
    return without_static_asserts(code)


def without_static_asserts(tokens):
    kept, inside = [], False
    for token in tokens:
        inside = inside or token.text == "static_assert"
        if not inside:
            kept.append(token)
        inside = inside and token.text != ";"
    return kept


def template_arguments(tokens, text):
    """Places of the tokens between the brackets of templates."""
    inside, open_at = set(), []
    for place, token in enumerate(tokens):
        if token.text == "<" and not between_blanks(token, text):
            open_at.append(place)
        elif token.text in (">", ">>") and open_at and not between_blanks(token, text):
            for _ in token.text:
                if open_at:
                    inside.update(range(open_at.pop(), place + 1))
        elif token.text in (";", "{"):
            open_at.clear()
    return inside


def between_blanks(token, text):
    before = text[token.start - 1 : token.start]
    after = text[token.end : token.end + 1]
    return before.isspace() and after.isspace()


def number_changes(number):
    """One more and one less, in the same type."""
    match = re.fullmatch(r"(\d[\d']*)([uUlLzZ]*)", number)
    if match:
        value, suffix = int(match.group(1).replace("'", "")), match.group(2)
        return [f"{value + 1}{suffix}", f"{value - 1}{suffix}" if value > 0 or not suffix else f"({value}{suffix} - 1)"]
    try:
        value = float(number)
    except ValueError:
        return []
    return [repr(value + 1.0), f"({value - 1.0!r})"] if value + 1.0 != value else []


def is_unary(tokens, place):
    if place == 0:
        return False
    before = tokens[place - 1]
    return before.text in ("(", ",", "=", "return", "?", ":", "{", "[", "&&", "||", "!") or before.text in BINARY


def token_changes(tokens, text):
    """(start, end, new text, name of the change) of single tokens."""
    templates = template_arguments(tokens, text)
    for place, token in enumerate(tokens):
        if place in templates:
            continue
        for new in [*one_token(tokens, place, text)]:
            yield token.start, token.end, new, f"`{token.text}` -> `{new}`"
        if token.text == "?" and between_blanks(token, text):
            for new in ("&& false ?", "|| true ?"):
                yield token.start, token.end, new, f"`?` -> `{new}`"


def one_token(tokens, place, text):
    token = tokens[place]
    if token.kind == "number":
        yield from number_changes(token.text)
    elif token.text in ("true", "false"):
        yield "false" if token.text == "true" else "true"
    elif token.text in ("++", "--"):
        yield "--" if token.text == "++" else "++"
    elif token.text in BINARY and between_blanks(token, text):
        yield from BINARY[token.text]
    elif token.text in UNARY_REMOVED and is_unary(tokens, place):
        yield ""


def closing(tokens, place):
    """Place of the bracket that closes the one at `place`."""
    depth = 0
    for at in range(place, len(tokens)):
        depth += tokens[at].text in ("(", "{", "[")
        depth -= tokens[at].text in (")", "}", "]")
        if depth == 0:
            return at
    return None


def condition_changes(tokens):
    """Conditions of if and while, negated."""
    for place, token in enumerate(tokens[:-1]):
        if token.text not in ("if", "while") or tokens[place + 1].text != "(":
            continue
        last = closing(tokens, place + 1)
        if last is not None:
            yield tokens[place + 1].end, tokens[last].start, "!(" + WHOLE + ")", f"{token.text} (...) -> {token.text} (!(...))"


def statement_ends(tokens):
    """Pairs of places (first, semicolon) of statements without blocks of their own, inside functions."""
    first, round_depth = 0, 0
    header_ends = set()
    for place, token in enumerate(tokens):
        if token.text in ("if", "for", "while", "switch") and place + 1 < len(tokens):
            last = closing(tokens, place + 1)
            if last is not None:
                header_ends.add(last)
        round_depth += token.text in ("(", "[")
        round_depth -= token.text in (")", "]")
        if round_depth == 0 and (token.text in ("{", "}", "else") or place in header_ends):
            first = place + 1
        elif round_depth == 0 and token.text == ";":
            yield first, place
            first = place + 1


def statement_changes(tokens, text):
    """Statements left out, and returns of the value that an empty pair of braces makes."""
    for first, last in statement_ends(tokens):
        if first >= last:
            continue
        head, before = tokens[first], tokens[first - 1] if first > 0 else None
        start, end = head.start, tokens[last].start
        if head.text == "return":
            conditional = before is not None and before.text in (")", "else")
            if conditional or last == first + 1:
                yield start, end, "", "the return is left out"
            if last > first + 1 and not is_empty(text[tokens[first + 1].start : end]):
                yield start, end, "return {}", "return ... -> return {}"
        elif head.text not in NOT_DELETED and not is_declaration(tokens, first, last):
            yield start, end, "", "the statement is left out"


def is_empty(value):
    """True of what an empty pair of braces makes as well: of a truth value, a number, an enumeration of faults."""
    return value in ("{}", "false", "0", "0.0") or value.endswith("Fault::none")


def is_declaration(tokens, first, last):
    """`Type name;`, `Type name = ...;`, `Type& name = ...;`: a word that is followed by another."""
    words = [t for t in tokens[first:last]]
    place = 0
    while place + 2 < len(words) and words[place + 1].text == "::":
        place += 2
    if words[place].kind != "word":
        return False
    after = place + 1
    if after < len(words) and words[after].text == "<":
        depth = 0
        while after < len(words):
            depth += words[after].text == "<"
            depth -= {">": 1, ">>": 2}.get(words[after].text, 0)
            after += 1
            if depth <= 0:
                break
    while after < len(words) and words[after].text in ("&", "*", "const"):
        after += 1
    return after < len(words) and words[after].kind == "word" and words[place].text not in ("return", "break", "continue")


FUNCTION = re.compile(r"^(?: {4})?(?:\[\[nodiscard\]\] )?[A-Za-z_][\w:<>&*, ]*[ &*:](operator\S+?|[A-Za-z_]\w*)\([^;]*$")


RECORD = re.compile(r"^(?:struct|class) (\w+)")


def function_of(text, start):
    """Name of the function or the struct in which a place lies: the last line, up to its own, that begins one."""
    line_end = text.find("\n", start)
    name = "?"
    for line in text[: line_end if line_end >= 0 else len(text)].split("\n"):
        # The body of a function of one line is no part of its head.
        match = FUNCTION.match(re.split(r" (?:noexcept|const) \{| \{", line)[0])
        if record := RECORD.match(line):
            name = record.group(1)
        elif match and not re.match(r" *(if|for|while|switch|return|else|case|throw)\b", line):
            name = match.group(1)
    return name


def mutants(path, text):
    """Every mutant of a file."""
    tokens = tokens_of(text)
    changes = [*token_changes(tokens, text), *condition_changes(tokens), *statement_changes(tokens, text)]
    seen = {}
    for start, end, new, change in sorted(changes, key=lambda c: (c[0], c[1], c[3])):
        line = text[text.rfind("\n", 0, start) + 1 :].split("\n", 1)[0].strip()
        spot = (function_of(text, start), line, change)
        seen[spot] = seen.get(spot, 0) + 1
        mutated = text[:start] + new.replace(WHOLE, text[start:end]) + text[end:]
        yield Mutant(path, *spot, seen[spot], text.count("\n", 0, start) + 1, mutated)
