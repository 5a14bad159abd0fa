"""What the headers of the core declare, for the checks that ask whether each of it has something."""
import re

# In front of these no function or type is declared.
NO_DECLARATION = re.compile(r"^\s*(using|static_assert|typedef|friend|#|template\s*<[^>]*>\s*using)\b")
FUNCTION = re.compile(r"(?<![\w.>~])(~?[A-Za-z_]\w*)\s*\(")
NOT_FUNCTIONS = {"decltype", "sizeof", "alignof", "noexcept", "static_assert", "operator"}
INTERNAL = {"detail", "kernels"}
# Folders of the core that hold what operators are made of.
FOUNDATIONS = {"base", "number", "linear", "simd", "image", "stream", "catalogue"}


def without_comments(text):
    text = re.sub(r"//[^\n]*|/\*.*?\*/", "", text, flags=re.DOTALL)
    text = re.sub(r'"(\\.|[^"\\])*"|\'(\\.|[^\'\\])*\'', '""', text)
    text = re.sub(r"\[\[.*?\]\]", "", text)
    return re.sub(r"^\s*#(?:[^\n]*\\\n)*[^\n]*", "", text, flags=re.MULTILINE)


def interface_of(text):
    """The part between the two headings; all of a header without them."""
    start, end = text.find("// ---- Interface"), text.find("// ---- Implementation")
    return text[max(start, 0):end if end >= 0 else len(text)]


def opened_scope(statement):
    """What a brace opens behind these words: (kind, name)."""
    words = re.sub(r"template\s*<.*?>\s*(?=class|struct|inline|constexpr|friend|void|\w)", "", statement, flags=re.DOTALL).strip()
    if found := re.match(r"(?:inline\s+)?namespace\s+([\w:]+)", words):
        return "namespace", found[1].split("::")[-1]
    if found := re.match(r"(class|struct|union)\s+(\w+)(?:\s+final)?\s*(?::[^:].*)?$", words, re.DOTALL):
        return found[1], found[2]
    if found := re.match(r"enum\s+(?:class\s+|struct\s+)?(\w+)", words):
        return "enum", found[1]
    return "body", ""


def declared(text):
    """The public functions: of namespaces by name, of classes as Class::member."""
    scopes, public, statement, names = [], [True], "", []

    def function_in(words):
        before = words.split("=")[0] if "operator" not in words else ""
        if NO_DECLARATION.match(before) or not public[-1]:
            return
        plain = re.sub(r"template\s*<[^;{}]*?>\s+(?=\w)", "", before, count=1, flags=re.DOTALL)
        for found in FUNCTION.finditer(plain):
            # What ends in _ is a member that a constructor sets.
            if found[1] not in NOT_FUNCTIONS and not found[1].startswith("~") and not found[1].endswith("_"):
                owner = scopes[-1][1] + "::" if scopes and scopes[-1][0] in ("class", "struct", "union") else ""
                names.append(owner + found[1])
                return

    for character in text:
        inside_body = any(kind == "body" for kind, _ in scopes)
        if character == "{":
            kind, name = opened_scope(statement) if not inside_body else ("body", "")
            if kind == "body" and not inside_body:
                function_in(statement)
            hidden = not public[-1] or (kind == "namespace" and name in INTERNAL)
            scopes.append((kind, name))
            public.append(not hidden and kind != "class")
            statement = ""
        elif character == "}":
            if scopes:
                scopes.pop()
                public.pop()
            statement = ""
        elif character == ";":
            if not inside_body and not (scopes and scopes[-1][0] == "enum"):
                function_in(statement)
            statement = ""
        else:
            statement += character
            if found := re.search(r"\b(public|private|protected)\s*:$", statement):
                if scopes and scopes[-1][0] in ("class", "struct", "union") and all(
                        kind != "namespace" or name not in INTERNAL for kind, name in scopes):
                    public[-1] = found[1] == "public"
                statement = ""
    return sorted(set(names))


def is_used(name, text):
    last = name.split("::")[-1]
    # Called; or, for a function, handed over by its name; or, for a constructor, its type named.
    called = rf"\b{last}\b\s*(<[^;()]*>)?\s*[({{]"
    return bool(re.search(called if "::" in name and not last[0].isupper() else rf"\b{last}\b", text))
