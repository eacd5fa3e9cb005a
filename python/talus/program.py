"""The program `talus`: campaigns are run by it, so that a notebook and a cluster do the same."""
import json
import os
import shutil
import signal
import subprocess
import sys
import tempfile
import warnings

from ._core import ConfigError, Error


def program():
    """Path of `talus`: $TALUS_PROGRAM, or the one on the path."""
    found = os.environ.get("TALUS_PROGRAM") or shutil.which("talus")
    if found is None:
        raise FileNotFoundError("the program `talus` is not on the path; put it there, or name it in TALUS_PROGRAM")
    file = shutil.which(found)  # a name on the path is one, too
    if file is None:
        raise FileNotFoundError(f"TALUS_PROGRAM={found}: is no program; name `talus`")
    return os.path.abspath(file)


def path(name):
    """A file or folder as an argument, never a flag."""
    return os.path.abspath(name) if os.fspath(name).startswith("-") else name


def teller(progress):
    """What is called with each event: `progress` itself, for True a Progress, for False and None nothing."""
    if progress is True:
        return Progress()
    if progress is None or progress is False:
        return lambda event: None
    if not callable(progress):
        raise ConfigError(f"progress: must be True, False or a function of an event; it is {progress!r}")
    return progress


def _warn(text):
    """A warning that names the user's own line, the first outside of this package."""
    frame, level = sys._getframe(), 1
    while frame.f_back and frame.f_globals.get("__package__") == __package__:
        frame, level = frame.f_back, level + 1
    warnings.warn(text, stacklevel=level)


def _without_warnings(words):
    """What a verb says on standard error but for its warnings, which become Python's."""
    others = []
    for line in words.splitlines():
        if line.startswith("warning: "):
            _warn(line.removeprefix("warning: "))
        else:
            others.append(line)
    return "\n".join(others)


def _raise(code, text):
    words = text.strip().removeprefix("talus: ").removesuffix("\nRun with --help for more information.") or f"talus ended with status {code}"
    if code == 2:
        raise ConfigError(words)
    if code == 130:
        raise KeyboardInterrupt(words)
    raise Error(words)


def call(*arguments):
    """What a verb prints."""
    ended = subprocess.run([program(), *map(str, arguments)], capture_output=True, text=True)
    words = _without_warnings(ended.stderr)
    if ended.returncode:
        _raise(ended.returncode, words)
    return ended.stdout


def ask(*arguments):
    """What a verb says with --json."""
    return json.loads(call(*arguments, "--json"))


class Progress:
    """Tells of a campaign while it runs: a line that changes in place, elsewhere a line a minute."""
    PERIOD = 60  # seconds between two lines

    def __init__(self, stream=None):
        self.stream = stream or sys.stderr
        self.in_place = self.stream.isatty() or "ipykernel" in sys.modules
        self.said = None

    def __call__(self, event):
        if event["event"] == "message":
            self._line(event["text"])
        elif event["event"] == "progress":
            self._status(event)
        elif event["event"] == "result" and self.in_place:
            print(file=self.stream)

    def _line(self, text):
        print(("\r\033[K" if self.in_place else "") + text, file=self.stream, flush=True)

    def _status(self, event):
        import time
        text = f"{event['num_search']} simulation" + ("" if event["num_search"] == 1 else "s")
        if event["num_confirm"]:
            text += f", {event['num_confirm']} to confirm"
        if event.get("best_objective") is not None:
            text += f", best {event['best_objective']:.3g} {event['unit']}"
        if event.get("seconds_left") is not None:
            text += f", at most {event['seconds_left']:.0f} s left"
        now = time.monotonic()
        if self.in_place:
            print("\r\033[K" + text, end="", file=self.stream, flush=True)
        elif self.said is None or now - self.said >= self.PERIOD:
            self.said = now
            print(text, file=self.stream, flush=True)


def run(arguments, tell):
    """Runs a verb that works on a campaign; `tell` is called with each event."""
    # A file holds what it says, however much: nobody reads a second pipe meanwhile.
    with tempfile.TemporaryFile("w+") as said, \
            subprocess.Popen([program(), *map(str, arguments), "--json"], stdout=subprocess.PIPE,
                             stderr=said, text=True) as process:
        try:
            for line in process.stdout:
                tell(json.loads(line))
        except BaseException:  # Ctrl-C, or the user's own function: the campaign can be resumed
            process.send_signal(signal.SIGTERM)
            process.communicate()  # so that it need not wait for us to read
            raise
        process.wait()
        said.seek(0)
        words = _without_warnings(said.read())
    if process.returncode:
        _raise(process.returncode, words)
