"""What is run in YADE: a module with `main` is a command of `python3 yade_scripts`.

The others serve them: `command` the command line, `shaking` one scene under one motion, `runner`
and `journal` many runs of a case of which finished ones are kept, `search` which intensity comes
next, `perturb` and `confirm` realisations, `tables` what is written.
"""
