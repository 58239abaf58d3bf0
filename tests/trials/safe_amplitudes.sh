#!/bin/sh
# Curves that chose no limit of "safe": 30 of the block on E/h, 40 in four courses, 400 histories in every 1 % from the
# safe amplitude down to 0.85 of it, and of courses 60 at a quarter of the step. From the folder of the repository:
#     sh tests/trials/safe_amplitudes.sh safe.csv
set -e
python=.venv/bin/python trial=tests/trials/safe_amplitudes.py
how="--each 400 --down 0.85 --above 0 --output ${1:-safe.csv}"
block() { $python $trial $how "$@"; }
courses() { $python $trial $how --courses --finer 0.25 60 "$@"; }

block S28:W2m:pos:3001 GMN_NS:W2m:neg S22:W2:neg:3001 S26:W1:pos:3001 S42:W2m:neg:3001
courses S28:W2m:neg:3002 GMN_NS:W2m:pos S22:W2:pos:3002 S26:W1:neg:3002 S42:W2m:pos:3002
block S12:W2m:pos:3001 S37:W2:neg:3001 S23:W2m:neg:3001 GMN_WE:W2:pos S02:W1:neg:3001
courses S12:W2m:neg:3002 S37:W2:pos:3002 S23:W1:pos:3002 GMN_WE:W2:neg S02:W2m:pos:3002
block S30:W2m:pos:3001 S38:W2:neg:3001 S35:W2m:neg:3001 IS113_Lo:W2m:neg S27:W1:pos:3001
courses S30:W2m:neg:3002 S38:W2:pos:3002 S35:W1:neg:3002 IS113_Tr:W2m:pos S27:W2m:neg:3002
block S29:W2m:pos:3001 S15:W2:pos:3001 S18:W2m:neg:3001 LPCC_H1:W2m:neg S21:W1:neg:3001
courses S29:W2:neg:3002 S15:W2m:pos:3002 S18:W1:pos:3002 IS113_Lo:W2:pos S21:W2m:pos:3002
block S07:W2m:pos:3001 S43:W2:pos:3001 S24:W2m:neg:3001 IS113_Tr:W1:pos IS101_Tr:W2m:neg
courses S07:W2:pos:3002 S43:W2m:neg:3002 S24:W1:neg:3002 LPCC_H2:W2m:pos IS101_Tr:W2m:pos
block S33:W2m:neg:3001 S32:W2:pos:3001 S11:W2m:pos:3001 LPCC_H2:W2:neg IS105_Lo:W2m:pos
courses S33:W2m:pos:3002 S32:W1:pos:3002 S11:W2:neg:3002 GMN_NS:W1:neg IS105_Lo:W2m:neg
courses S28:W1:pos:3003 S22:W2m:neg:3003 S42:W2:neg:3003 S12:W1:pos:3003 S37:W2m:neg:3003
courses S23:W2:neg:3003 S02:W1:neg:3003 S30:W2m:pos:3003 S38:W1:neg:3003 S35:W2:pos:3003
