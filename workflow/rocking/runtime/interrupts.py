"""Ctrl-C and SIGTERM reach a run whatever it does at that moment.

Python drops a KeyboardInterrupt that is raised where nothing can catch it, in a destructor or a
callback of a weak reference: the run would go on to its end. Snakemake's handler of SIGTERM takes
the lock of its scheduler: where the signal meets the thread that holds it, the run would stand
still for ever. Here a thread of its own, which meets no signals, does what is to be done.
"""

import queue
import signal
import sys
import threading

from yade_scripts.lists import listed

MOST_NAMED = 4


def waiting(scheduler):
    """Say in one line for which jobs a run waits that is to end."""
    running = sorted(
        " ".join([job.rule.name, *map(str, job.wildcards_dict.values())])
        for job in list(getattr(scheduler, "running", ()))
        if hasattr(job, "rule")
    )
    if not running:
        return "SIGTERM: ending"
    named = listed(running, MOST_NAMED)
    return f"SIGTERM: ending after what runs now ({named}); Ctrl-C (SIGINT) ends it at once"


def heed(scheduler):
    """Let both signals reach a run from now on; called in the main thread.

    Upon SIGTERM the running jobs of Snakemake's scheduler end, and no other begins.
    """
    end = scheduler.exit_gracefully
    came: queue.SimpleQueue = queue.SimpleQueue()  # may be put to whatever a signal interrupted
    main = threading.get_ident()
    dropped = sys.unraisablehook

    def watch():
        for number in iter(came.get, None):
            if number == signal.SIGTERM:
                print(waiting(scheduler), file=sys.stderr, flush=True)
                end()
            else:
                signal.pthread_kill(main, number)

    def drop(what):
        if issubclass(what.exc_type, KeyboardInterrupt):
            came.put(signal.SIGINT)
        else:
            dropped(what)

    threading.Thread(target=watch, name="interrupts", daemon=True).start()
    signal.signal(signal.SIGTERM, lambda number, frame: came.put(number))
    sys.unraisablehook = drop
