# SPDX-License-Identifier: MIT
# The chart of the sweep: ns per vertex against vertices per instance, a line for each number of instances, a panel for
# each set of streams and number of threads.
#   gnuplot -e "data='sweep.dat'; chart='sweep.svg'; threads='1 2'; low=0.1; high=10" chart.gp
# report.py writes the data, names the data sets and calls this.
streams = "positions positions+normals"
instances = "1 10 100 1000 10000"
colors = "#d55e00 #c98a00 #009e73 #0072b2 #5b2a86"
gray = "#555555"

set terminal svg size 470 * words(threads) + 60, 840 font "sans-serif,13" background "white"
set output chart
set multiplot layout words(streams), words(threads) margins screen 0.07, 0.98, 0.13, 0.95 spacing screen 0.05, 0.1

set logscale xy
set xrange [150:2000000]
set yrange [low:high]
set grid xtics ytics lc rgb "#d8d8d8" lw 0.5
set tics nomirror
set border 3
set xtics ("200" 200, "500" 500, "2k" 2000, "10k" 10000, "50k" 50000, "200k" 200000, "1M" 1000000)
set ytics (0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1, 2, 5, 10, 20, 50, 100)
set key off

# The legend, once for all panels.
place(i) = 0.07 + 0.125 * (i - 1)
do for [i = 1:words(instances)] {
    set label i "● ".word(instances, i).(i == 1 ? " instance" : " instances") at screen place(i), 0.03 \
        textcolor rgb word(colors, i)
}
set label 6 "- - fill past cache" at screen place(6) + 0.02, 0.03 textcolor rgb gray
set label 7 "···· fill in cache" at screen place(7) + 0.04, 0.03 textcolor rgb gray

do for [row = 1:words(streams)] {
    do for [column = 1:words(threads)] {
        panel = word(streams, row)." ".word(threads, column)." "
        lines(i) = panel.word(instances, i)." instances"
        set title word(streams, row).", ".word(threads, column).(word(threads, column) eq "1" ? " thread" : " threads")
        set xlabel (row == words(streams) ? "vertices per instance" : "")
        set ylabel (column == 1 ? "ns per vertex" : "") offset 1
        plot data index panel."fill_nt" using 1:2 with lines lw 1.5 dt 2 lc rgb gray, \
             data index panel."fill_cache" using 1:2 with lines lw 1.5 dt 3 lc rgb gray, \
             for [i = 1:words(instances)] data index lines(i) using 1:2 with linespoints \
                 lw 2 pt 7 ps 0.5 lc rgb word(colors, i), \
             for [i = 1:words(instances)] data index lines(i) using 1:2:(strcol(3)) with labels \
                 left offset 0.6, 0 font ",11" textcolor rgb word(colors, i)
        unset label
    }
}
unset multiplot
