"""Jobs end with the run that started them.

A run of the workflow that is killed outright cannot stop its jobs. Left alone they
would go on computing and, later, write into a folder where another run works by then,
perhaps with another configuration. Each job therefore watches the process named in
RUN_PID and ends at once, without writing anything more, when that one is gone.
"""

import os
import select
import threading

RUN_PID = "ROCKING_RUN_PID"
ORPHANED = 143  # exit status of a job whose run is gone


def follow():
    """Watch the process named in RUN_PID and end with it; return whether a watch was started.

    The watch is a thread asleep on a process descriptor: it costs a run nothing. There is none
    where RUN_PID is not set, as when an entry point is run by hand, or where the system has no
    process descriptors (Linux before 5.3).
    """
    pid = os.environ.get(RUN_PID)
    if not pid or not hasattr(os, "pidfd_open"):
        return False
    try:
        descriptor = os.pidfd_open(int(pid))
    except ProcessLookupError:
        os._exit(ORPHANED)  # gone before this job had even started
    except (ValueError, OSError):
        return False
    threading.Thread(target=_wait, args=(descriptor,), name="parent_process", daemon=True).start()
    return True


def _wait(descriptor):
    poll = select.poll()
    poll.register(descriptor, select.POLLIN)
    poll.poll()
    os._exit(ORPHANED)
