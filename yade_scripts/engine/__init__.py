"""What turns a scene into YADE and steps it; the only place that imports YADE.

`adapter` builds a scene: blocks by `parts`, their contact by `faces`, `releases` and `bonds`,
whatever else joins them by `links`, `ties`, `floors` and `welds`, motions by `drives` and `guide`.
`simulate` runs it, `loop` takes the steps, `energy_check` watches every run and `balance` accounts
for one in full. `library` finds YADE; `memory` and `parent_process` are about the process.
"""
