# SPDX-License-Identifier: MIT
# The chart of a history (bench/gate --record): a panel for each case, its values over the commits, in its own unit.
# gating/history.py writes the data and sets data, chart, columns and the lists titles, units, commits, lows, highs.
panels = words(titles)
column_count = int(columns)
rows = (panels + column_count - 1) / column_count
set terminal svg size 310 * column_count, 175 * rows + 90 font "sans-serif,11" background "white"
set output chart
set multiplot layout rows, column_count margins screen 0.05, 0.985, 60.0 / (175 * rows + 90), \
    1 - 45.0 / (175 * rows + 90) spacing screen 0.05, 62.0 / (175 * rows + 90)

spaced(text) = system("echo '".text."' | tr _ ' '")

# Where there are many commits, some ten are named.
count = words(commits)
step = (count + 9) / 10
set xrange [-0.5 : count - 0.5]
set border 3 lc rgb "#888888"
set grid ytics lc rgb "#e4e4e4"
set tics nomirror scale 0.4 textcolor rgb "#444444"
set ytics font ",9"
set key off
do for [i = 1:panels] {
    set title spaced(word(titles, i))."\n{/*0.85 ".spaced(word(units, i))."}" offset 0, -0.6 font ",10"
    low = real(word(lows, i))
    high = real(word(highs, i))
    spread = (high - low) / 3
    set yrange [low : high]
    set ytics low, spread
    set format y (high >= 10000 ? "%.0f" : "%.4g")
    unset xtics
    set xtics nomirror rotate by 40 right font ",8" ("" 0)
    if (i > panels - column_count) {
        do for [at = 0 : count - 1 : step] { set xtics add (word(commits, at + 1) at) }
    }
    plot data index i - 1 using 1:3:4 with filledcurves lc rgb "#cfe3f3", \
         data index i - 1 using 1:2 with linespoints lw 1.6 pt 7 ps 0.35 lc rgb "#0072b2"
}
unset multiplot
