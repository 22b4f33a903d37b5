"""Pages of the commands, made of what the program and its companions say of themselves by --help.

Help has a sentence, a line "Usage: …", sections ("Options:") of items, examples and paragraphs. An item begins in column
2 and its text in column 26, of the same line or of the next.
"""

import dataclasses
import pathlib
import re
import subprocess

docs = pathlib.Path(__file__).resolve().parent.parent
text_column = 26
COMMANDS = re.compile(r"Commands:|Companion programs.*:")


@dataclasses.dataclass
class Item:
    name: str
    text: str


@dataclasses.dataclass
class Section:
    title: str
    items: list


@dataclasses.dataclass
class Command:
    words: tuple  # ("fathom", "camera", "look-at")
    summary: str = ""
    usage: str = ""
    sections: list = dataclasses.field(default_factory=list)
    examples: list = dataclasses.field(default_factory=list)
    paragraphs: list = dataclasses.field(default_factory=list)

    @property
    def page(self):
        return "-".join(self.words[1:]) or "fathom"

    @property
    def subcommands(self):
        return [item.name for section in self.sections if COMMANDS.match(section.title) for item in section.items]


def help_of(program, words):
    told = subprocess.run([program, *words[1:], "--help"], capture_output=True, text=True)
    if told.returncode:
        raise SystemExit(f"docs: error: {' '.join(words)} --help: {told.stderr.strip()}")
    return told.stdout


def parse(words, text):
    command = Command(words)
    summary, _, rest = text.partition("\nUsage: ")
    command.summary = " ".join(summary.split())
    command.usage, *lines = rest.splitlines()
    section, in_examples, paragraph = None, False, []
    for line in [*lines, ""]:
        if line == "Examples:":
            section, in_examples = None, True
        elif in_examples and line.startswith("  "):
            command.examples.append(line[2:])
        elif re.fullmatch(r"\S.*:", line) and not paragraph:
            section = Section(line, [])
            command.sections.append(section)
        elif section and line.startswith(" " * text_column):
            section.items[-1].text = f"{section.items[-1].text} {line.strip()}".strip()
        elif section and line.startswith("  "):
            section.items.append(item_of(line))
        elif line.strip():
            section, in_examples = None, False
            paragraph.append(line.strip())
        elif paragraph:
            command.paragraphs.append(" ".join(paragraph))
            paragraph = []
    return command


def item_of(line):
    whole = len(line) > text_column and line[text_column - 1] == " "
    return Item(line[:text_column].strip(), line[text_column:].strip()) if whole else Item(line.strip(), "")


def read_commands(program, words=("fathom",)):
    """The command and all below it, in the order of the help."""
    command = parse(words, help_of(program, words))
    found = [command]
    for name in command.subcommands:
        found += read_commands(program, (*words, name))
    return found


def escaped(text):
    """Text as Markdown that shows it as it is, with options as code."""
    parts = re.split(r"((?<![\w-])--?[a-z][a-z0-9-]*|\b[\w-]+(?:/[\w.-]+)*\.(?:json|md|exr|pfm|png)\b)", text)
    return "".join(code(part) if k % 2 else re.sub(r"([\\`*_{}\[\]<>#+!|~$^])", r"\\\1", part)
                   for k, part in enumerate(parts))


def code(text):
    """An option or a name of a file; one of a page is a link."""
    return f"[`{text}`](../../{text})" if text.endswith(".md") and (docs / text).is_file() else f"`{text}`"


def sentence(text):
    return text if text.endswith(".") else text + "."


def option(item):
    """An item as an entry of the index, with an address of its own."""
    name, *conditions = re.split(r" (Excludes|Needs|REQUIRED)(?::|\b)\s*", item.name)
    remarks = []
    for kind, what in zip(conditions[::2], conditions[1::2]):
        if kind == "REQUIRED":
            remarks.append("Required.")
        else:
            remarks.append(escaped(f"{'Not together with' if kind == 'Excludes' else 'Only with'} "
                                   f"{', '.join(what.split())}."))
    names = re.sub(r"^(-\w),(--)", r"\1, \2", name.strip())
    text = escaped(item.text)
    if remarks and text and not text.endswith("."):
        text += "."
    return f"```{{option}} {names}\n{' '.join([text, *remarks]).strip()}\n```\n"


def page(command, children):
    words = " ".join(command.words)
    parts = [f"# {words}\n", sentence(escaped(command.summary)) + "\n", f"```text\n{command.usage}\n```\n",
             f"```{{program}} {words}\n```\n"]
    for section in command.sections:
        if COMMANDS.match(section.title):
            names = {item.name for item in section.items}
            title = "Commands" if section.title == "Commands:" else "Companion programs"
            parts += [f"## {title}\n"] + [f"- [{' '.join(child.words)}]({child.page}.md): {escaped(child.summary)}"
                                          for child in children if child.words[-1] in names] + [""]
        else:
            parts += [f"## {section.title.rstrip(':')}\n", *map(option, section.items)]
    if command.examples:
        parts += ["## Examples\n", "```sh\n" + "\n".join(command.examples) + "\n```\n"]
    parts += [escaped(each) + "\n" for each in command.paragraphs]
    if children:
        names = [child.page for child in children]
        parts.append("```{toctree}\n:hidden:\n\n" + "\n".join(names) + "\n```\n")
    return "\n".join(parts)


def children_of(command, commands):
    return [each for each in commands if each.words[:-1] == command.words]


def pages(commands):
    """(name, text) of the page of each command."""
    return [(each.page, page(each, children_of(each, commands))) for each in commands]


def overview(commands):
    rows = [f"| [{' '.join(each.words)}](commands/{each.page}.md) | {escaped(each.summary)} |" for each in commands]
    return ("| command | what it does |\n| --- | --- |\n" + "\n".join(rows) +
            "\n\n```{toctree}\n:hidden:\n\ncommands/fathom\n```\n")
