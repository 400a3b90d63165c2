"""Mutants of C++ sources: small faults, found by a tokenizer, and a seeded draw among them.

A mutant replaces one span of one file. The operators:

  sign       exchanges + and -, += and -=, add() and subtract(); removes a unary minus or a negate()
  boundary   exchanges < and <=, > and >=, min() and max(); adds 1 to or subtracts 1 from an integer literal
  order      exchanges two operands or arguments of a non-commutative operation; replaces `a` by `b`, x_a by x_b and the reverse
  count      removes x += n; ++x; and similar statements (n is still evaluated)
  call       removes a statement that is a call, e.g. one that wakes, marks, visits or stores
  field      removes an assignment (its right side is still evaluated); replaces an element of an initialiser by {}
  condition  negates the condition of an if
  logic      exchanges && and ||
  jump       removes a return, continue or break under an if

Comments, strings, preprocessor lines, static_assert() and checks that are off by default are not mutated. A mutant need not
compile. The tokenizer relies on clang-format: a comparison has spaces around it, a template's bracket has none.
"""
import bisect
import hashlib
import random
import re
from dataclasses import dataclass

OPERATORS = ["sign", "boundary", "order", "count", "call", "field", "condition", "logic", "jump"]

TOKEN = re.compile(r"""[A-Za-z_]\w* | \.?\d(?:[\w.']|(?<=[eEpP])[+-])* |
  <<=|>>=|<=>|->\*?|::|\+\+|--|<<|>>|<=|>=|==|!=|&&|\|\||[-+*/%&|^]=|\.\.\.|.""", re.VERBOSE)
HIDDEN = re.compile(r"""//[^\n]* | /\*.*?\*/ | "(?:\\.|[^"\\\n])*" | (?<![\w])'(?:\\.|[^'\\\n])*' |
  ^[ \t]*\#(?:\\\n|[^\n])*""", re.VERBOSE | re.DOTALL | re.MULTILINE)
# Names whose arguments are not mutated.
UNTOUCHED = {"static_assert", "DETENT_VERIFY_RANGE", "__attribute__", "alignas", "noexcept", "decltype", "sizeof"}
KEYWORDS = set("""return else case goto new delete throw const constexpr static inline using typedef struct class enum union
  namespace template typename if for while do switch break continue default public private protected friend operator auto extern
  mutable virtual""".split())
COMMUTATIVE = {"add", "multiply", "dot", "min", "max", "static_assert"}
NEUTRAL = {"{}", "0", "0.0", "0u", "nullptr", "false"}
CLOSING = {"(": ")", "[": "]", "{": "}"}
ASSIGNMENTS = {"=", "+=", "-=", "*=", "/=", "%=", "&=", "|=", "^=", "<<=", ">>="}
COUNTING = {"+=", "-=", "|="}


@dataclass(frozen=True)
class Mutant:
    path: str
    operator: str
    start: int
    end: int
    replacement: str
    line: int
    before: str  # the lines that change, joined to one without indentation; `after`: the same lines mutated
    after: str
    id: str

    def apply(self, text):
        return text[:self.start] + self.replacement + text[self.end:]


def blank(text):
    """Returns the text with spaces in place of all that is not code."""
    return HIDDEN.sub(lambda match: re.sub(r"[^\n]", " ", match[0]), text)


@dataclass
class Token:
    text: str
    start: int
    end: int
    spaced: bool  # white space on both sides


class Source:
    def __init__(self, path, text):
        self.path, self.text = path, text
        self.code = blank(text)
        self.tokens = []
        for match in TOKEN.finditer(self.code):
            if not match[0].isspace():
                around = self.code[match.start() - 1:match.start()] + self.code[match.end():match.end() + 1]
                self.tokens.append(Token(match[0], match.start(), match.end(), around.strip() == ""))
        self.partner = {}  # index of the matching bracket, in both directions
        open_ = []
        for i, token in enumerate(self.tokens):
            if token.text in CLOSING:
                open_.append(i)
            elif token.text in CLOSING.values():
                if open_:
                    self.partner[i] = open_.pop()
                    self.partner[self.partner[i]] = i
        self.lines = [0] + [match.end() for match in re.finditer("\n", text)]
        self.code_lines = sum(1 for line in self.code.split("\n") if line.strip())
        self.untouched = self._untouched()
        self.found = []

    def _untouched(self):
        hidden = [False] * len(self.tokens)
        for i, token in enumerate(self.tokens):
            if token.text in UNTOUCHED and self.at(i + 1) == "(" and i + 1 in self.partner:
                for k in range(i, self.partner[i + 1] + 1):
                    hidden[k] = True
        return hidden

    def at(self, i):
        return self.tokens[i].text if 0 <= i < len(self.tokens) else ""

    def is_word(self, i):
        return bool(re.match(r"[A-Za-z_]", self.at(i))) and self.at(i) not in KEYWORDS

    def is_value_end(self, i):
        """Returns whether an operand may end with this token."""
        return self.is_word(i) or self.at(i) in (")", "]", "}") or bool(re.match(r"\.?\d", self.at(i)))

    def text_of(self, first, last):
        return self.text[self.tokens[first].start:self.tokens[last].end]

    def line_of(self, position):
        return bisect.bisect_right(self.lines, position)

    def change(self, operator, first, last, replacement):
        """Adds a mutant that replaces the tokens from `first` to `last`."""
        if any(self.untouched[first:last + 1]):
            return
        start, end = self.tokens[first].start, self.tokens[last].end
        if self.text[start:end] == replacement:
            return
        line, last_line = self.line_of(start), self.line_of(end - 1)
        low = self.lines[line - 1]
        high = self.lines[last_line] - 1 if last_line < len(self.lines) else len(self.text)
        tidy = lambda text: " ".join(text.split())
        before = tidy(self.text[low:high])
        after = tidy(self.text[low:start] + replacement + self.text[end:high])
        self.found.append((operator, start, end, replacement, line, before, after))

    def exchange(self, operator, first, second):
        """Adds a mutant that exchanges two spans of tokens, (first, last) each."""
        a, b = self.text_of(*first), self.text_of(*second)
        between = self.text[self.tokens[first[1]].end:self.tokens[second[0]].start]
        if " ".join(a.split()) != " ".join(b.split()):
            self.change(operator, first[0], second[1], b + between + a)

    def elements(self, opening):
        """Returns the spans between the commas of a bracket; None if it is empty or may contain the commas of a template."""
        closing = self.partner.get(opening)
        if closing is None or closing == opening + 1:
            return None
        spans, first, i = [], opening + 1, opening + 1
        while i < closing:
            if self.at(i) in CLOSING:
                i = self.partner.get(i, closing)
            elif self.at(i) == ";":
                return None
            elif self.at(i) == "<" and not self.tokens[i].spaced:
                return None
            elif self.at(i) == ",":
                spans.append((first, i - 1))
                first = i + 1
            i += 1
        if first < closing:
            spans.append((first, closing - 1))
        return None if any(last < first for first, last in spans) else spans

    def is_declaration(self, span):
        """Returns whether a span looks like a parameter: two words in a row, or the & or * of a type."""
        for i in range(span[0], span[1] + 1):
            if self.at(i) in ("const", "auto", "class", "typename", "..."):
                return True
            if i < span[1] and self.is_word(i) and self.is_word(i + 1):
                return True
            if self.at(i) in ("&", "*", "&&") and i > span[0] and not self.tokens[i].spaced and self.is_value_end(i - 1):
                return True
        return False

    def chain_from(self, i):
        """Returns the last token of the operand that starts here (names, members, calls, indices), or None."""
        while self.at(i) in ("-", "!", "*", "&", "~"):
            i += 1
        if re.match(r"\.?\d", self.at(i)):
            return i
        if self.at(i) == "(":
            i = self.partner.get(i)
        elif not self.is_word(i):
            return None
        while i is not None:
            following = self.at(i + 1)
            if following in (".", "->", "::") and self.is_word(i + 2):
                i += 2
            elif following in ("(", "["):
                i = self.partner.get(i + 1)
            elif following == "<" and not self.tokens[i + 1].spaced:
                k = i + 2
                while k < len(self.tokens) and (self.is_word(k) or self.at(k) in ("::", ",", "const", "*", "&")):
                    k += 1
                if self.at(k) != ">" or self.at(k + 1) not in ("(", "{"):
                    return i
                i = self.partner.get(k + 1)
            else:
                return i
        return None

    def chain_to(self, i):
        """Returns the first token of the operand that ends here, or None."""
        while True:
            if self.at(i) in (")", "]"):
                opening = self.partner.get(i)
                if opening is None:
                    return None
                if self.is_word(opening - 1) or self.at(opening - 1) in (")", "]"):
                    i = opening - 1
                    continue
                return opening if self.at(i) == ")" else None
            if not (self.is_word(i) or re.match(r"\.?\d", self.at(i))):
                return None
            if self.at(i - 1) in (".", "->", "::"):
                i -= 2
                continue
            return i

    # The operators.

    def mutate_tokens(self):
        # `a` is replaced by `b` only where both occur close by.
        words = {}
        for i, token in enumerate(self.tokens):
            if self.is_word(i):
                words.setdefault(token.text, []).append(token.start)
        for i, token in enumerate(self.tokens):
            text = token.text
            binary = token.spaced and self.is_value_end(i - 1)
            if text in ("+", "-") and binary:
                self.change("sign", i, i, "-" if text == "+" else "+")
            elif text == "-" and not self.is_value_end(i - 1) and self.at(i + 1) != "-":
                self.change("sign", i, i + 1, self.at(i + 1))
            elif text in ("+=", "-="):
                self.change("sign", i, i, "-=" if text == "+=" else "+=")
            elif text in ("add", "subtract") and self.at(i + 1) == "(" and not self.is_word(i - 1):
                self.change("sign", i, i, "subtract" if text == "add" else "add")
            elif text == "negate" and self.at(i + 1) == "(" and not self.is_word(i - 1):
                self.change("sign", i, i + 1, "(")
            elif text in ("min", "max") and self.at(i + 1) == "(" and not self.is_word(i - 1):
                self.change("boundary", i, i, "max" if text == "min" else "min")
            elif text in ("&&", "||") and binary:
                self.change("logic", i, i, "||" if text == "&&" else "&&")
            elif re.fullmatch(r"\d{1,5}u?", text) and self.at(i - 1) not in (".",):
                value, suffix = int(text.rstrip("u")), "u" if text.endswith("u") else ""
                self.change("boundary", i, i, f"{value + 1}{suffix}")
                if value > 0:
                    self.change("boundary", i, i, f"{value - 1}{suffix}")
            if text in ("<", "<=", ">", ">=") and binary:
                self.change("boundary", i, i, text + "=" if len(text) == 1 else text[0])
            if text in ("<", "<=", ">", ">=", "-", "/", "<<", ">>", "%") and binary:
                first, last = self.chain_to(i - 1), self.chain_from(i + 1)
                if first is not None and last is not None:
                    self.exchange("order", (first, i - 1), (i + 1, last))
            if self.is_word(i) and re.search(r"(^|_)[ab]$", text):
                other = text[:-1] + ("b" if text[-1] == "a" else "a")
                if any(abs(place - token.start) < 800 for place in words.get(other, [])):
                    self.change("order", i, i, other)
            if self.is_word(i) and self.at(i + 1) in ("(", "{") and text not in COMMUTATIVE:
                spans = self.elements(i + 1) or []
                if not any(self.is_declaration(span) for span in spans):
                    for first, second in zip(spans, spans[1:]):
                        self.exchange("order", first, second)
            if text == "{":
                self.mutate_initialiser(i)
            if text == "if" and self.at(i + 1) == "(" and i + 1 in self.partner:
                self.negate(i + 1)

    def mutate_initialiser(self, i):
        before = self.at(i - 1)
        if before in (")", "else", "do", ";", "{", "}", ":", "") and before != "{":
            return
        if any(self.at(k) in ("enum", "namespace", "struct", "class", "union") for k in range(max(0, i - 4), i)):
            return
        for first, last in self.elements(i) or []:
            if self.at(first) == "." and self.is_word(first + 1) and self.at(first + 2) == "=":
                first += 3
            if first <= last and self.text_of(first, last) not in NEUTRAL:
                self.change("field", first, last, "{}")

    def negate(self, opening):
        first, last = opening + 1, self.partner[opening] - 1
        depth = first
        while depth <= last:  # skips an init-statement
            if self.at(depth) in CLOSING:
                depth = self.partner.get(depth, last)
            elif self.at(depth) == ";":
                first = depth + 1
            depth += 1
        if any(self.at(k) == "=" for k in range(first, last + 1)):  # the condition is a declaration
            return
        self.change("condition", first, last, f"!({self.text_of(first, last)})")

    def statement_end(self, i):
        """Returns the semicolon that ends the statement which starts here, or None."""
        while i < len(self.tokens):
            if self.at(i) == ";":
                return i
            if self.at(i) in CLOSING:
                i = self.partner.get(i, len(self.tokens))
            elif self.at(i) in CLOSING.values():
                return None
            i += 1
        return None

    def header_before(self, i):
        """Returns the keyword whose parentheses end right before this token, or an empty string."""
        if self.at(i - 1) != ")" or i - 1 not in self.partner:
            return ""
        keyword = self.partner[i - 1] - 1
        if self.at(keyword) == "constexpr":
            keyword -= 1
        return self.at(keyword) if self.at(keyword) in ("if", "for", "while", "switch") else ""

    def is_label_end(self, i):
        first = i
        while self.at(i) == ":" and first > 0 and self.at(first - 1) not in (";", "{", "}", ":"):
            first -= 1
        return self.at(first) in ("case", "default")

    def mutate_statements(self):
        enclosing = []
        for i in range(len(self.tokens)):
            if self.at(i) in CLOSING.values() and enclosing:
                enclosing.pop()
            outer = enclosing[-1] if enclosing else None
            if self.at(i) in CLOSING:
                enclosing.append(i)
            if outer is None or self.at(outer) != "{":
                continue
            header = self.header_before(i)
            begins = header != "" or self.at(i - 1) in (";", "{", "}", "else") or self.is_label_end(i - 1)
            end = self.statement_end(i) if begins else None
            if end is None or end == i or self.at(i) == "(" or header == "while":  # an endless loop
                continue
            guarded = header == "if" or self.header_before(outer) == "if"
            if self.at(i) in ("return", "continue", "break"):
                if guarded:
                    self.change("jump", i, end, "{}")
                continue
            if self.at(i) in ("++", "--"):
                if self.chain_from(i + 1) == end - 1:
                    self.change("count", i, end, "{}")
                continue
            last = self.chain_from(i)
            if last is None:
                continue
            following = self.at(last + 1)
            if following in ("++", "--") and last + 2 == end:
                self.change("count", i, end, "{}")
            elif following in ASSIGNMENTS and last + 2 <= end - 1:
                value = self.text_of(last + 2, end - 1)
                if value in ("default", "delete"):
                    continue
                dropped = "{}" if value.startswith("{") else f"static_cast<void>({value});"
                self.change("count" if following in COUNTING else "field", i, end, dropped)
            elif last + 1 == end and self.at(last) == ")" and not re.fullmatch(r"[A-Z_0-9]+", self.at(i)):
                self.change("call", i, end, "{}")

    def mutants(self):
        self.mutate_tokens()
        self.mutate_statements()
        result, seen = [], {}
        for operator, start, end, replacement, line, before, after in sorted(set(self.found), key=lambda found: found[1:4]):
            # Equal changes of equal lines are numbered, so that the id does not depend on line numbers.
            key = "\0".join((self.path, operator, before, after))
            seen[key] = seen.get(key, 0) + 1
            name = hashlib.sha256(f"{key}\0{seen[key]}".encode()).hexdigest()[:8]
            result.append(Mutant(self.path, operator, start, end, replacement, line, before, after, name))
        return result


def draw(sources, seed, operators=OPERATORS):
    """Returns for each operator an iterator over its mutants of the sources (pairs of path and text) in random order; a file is
    drawn in proportion to its lines of code. The same seed and sources give the same order."""
    pools, lines = {operator: {} for operator in operators}, {}
    for path, text in sorted(sources):
        source = Source(path, text)
        lines[path] = source.code_lines
        for mutant in source.mutants():
            if mutant.operator in pools:
                pools[mutant.operator].setdefault(path, []).append(mutant)

    def drawn(operator, pool):
        chooser = random.Random(f"{seed} {operator}")
        while pool:
            files = list(pool)
            path = chooser.choices(files, [lines[name] for name in files])[0]
            yield pool[path].pop(chooser.randrange(len(pool[path])))
            if not pool[path]:
                del pool[path]

    return {operator: drawn(operator, pools[operator]) for operator in operators}
