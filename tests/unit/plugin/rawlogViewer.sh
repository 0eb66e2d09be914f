#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# RawLogViewer with a plug-in on a screen of its own, until the file STOP appears in FOLDER.
#   rawlogViewer.sh FOLDER PLUGIN RAWLOG
# FOLDER gets: display (its number), Xvfb_screen0 (the picture, as XWD), viewer.log, viewer.ended if it ends by itself.
cd "$1" || exit 1
export HOME="$1" LIBGL_ALWAYS_SOFTWARE=1
Xvfb -displayfd 3 -screen 0 1400x1000x24 +extension GLX -fbdir "$1" 3>display.new >xvfb.log 2>&1 &
xvfb=$!
trap 'kill $viewer $manager 2>/dev/null; sleep 0.2; kill $xvfb 2>/dev/null' EXIT
while ! [ -s display.new ]; do kill -0 $xvfb || exit 1; sleep 0.1; done
export DISPLAY=":$(cat display.new)"
openbox >/dev/null 2>&1 &
manager=$!
(RawLogViewer -l "$2" "$3" >viewer.log 2>&1; touch viewer.ended) &
viewer=$!
mv display.new display
while ! [ -e STOP ]; do sleep 0.1; done
