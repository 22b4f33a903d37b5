"""Shells with the completion of fathom, in a terminal of their own, as a user has them."""

import os
import pty
import re
import select
import subprocess
import time

from fathom_help import answer, path_with_program


class Terminal:
    """An interactive shell, into which keys are typed."""

    def __init__(self, command: list[str], setup: list[str], folder: str):
        master, slave = pty.openpty()
        environment = {"PATH": path_with_program(), "TERM": "dumb", "HOME": folder, "LC_ALL": "C.UTF-8",
                       "HISTFILE": "/dev/null"}
        self.process = subprocess.Popen(command, stdin=slave, stdout=slave, stderr=slave, cwd=folder, env=environment,
                                        start_new_session=True)
        os.close(slave)
        self.terminal = master
        for line in setup:
            self.type(line + "\n")
        self.until("SET-UP-DONE\r\n")

    def type(self, keys: str) -> None:
        os.write(self.terminal, keys.encode())

    def until(self, end: str, seconds: float = 20) -> str:
        shown, deadline = "", time.monotonic() + seconds
        while end not in shown:
            ready, _, _ = select.select([self.terminal], [], [], max(0, deadline - time.monotonic()))
            assert ready, f"the shell does not come to {end!r}; it shows {shown!r}"
            shown += os.read(self.terminal, 65536).decode()
        return shown

    def line_after(self, keys: str) -> str:
        """What stands on the command line after these keys: the shell itself prints it, as an argument."""
        self.type(keys)
        time.sleep(0.05)
        self.type("'\x01printf '<%s>\\n' '\n")  # a quote; at the beginning, what prints it
        shown = self.until(">\r\n")
        return re.findall(r"<(.*)>\r\n", shown)[-1]

    def close(self) -> None:
        self.process.kill()
        self.process.wait()
        os.close(self.terminal)


def terminal(shell: str, folder: str) -> Terminal:
    script = os.path.join(folder, f"completion.{shell}")
    with open(script, "w") as file:
        file.write(answer("completion", shell))
    done = "echo SET-UP-'DONE'"
    if shell == "bash":
        return Terminal(["bash", "--norc", "--noprofile", "-i"], [f"source {script}", "bind 'set bell-style none'", done],
                        folder)
    return Terminal(["zsh", "-f", "-i"],
                    ["unsetopt zle_bracketed_paste; bindkey -e; PS1='> '", "autoload -Uz compinit; compinit -u -D",
                     f"source {script}", done], folder)
