"""What all tests share: an end for every process that a test starts."""

import functools
import os
import signal
import subprocess

LIMIT_S = 800.0  # of a subprocess whose test states none; below the limit of a test

# what runs in YADE ends with the tests that started it
os.environ["ROCKING_RUN_PID"] = str(os.getpid())

# a shell starts what is in its background with SIGINT ignored, which every process here would
# inherit: no run that a test interrupts would notice
signal.signal(signal.SIGINT, signal.default_int_handler)

# `timeout` given at a call wins
subprocess.run = functools.partial(subprocess.run, timeout=LIMIT_S)
