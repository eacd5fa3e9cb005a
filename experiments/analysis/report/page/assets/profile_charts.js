// The experiment's stand out; of a film it has several, told apart by their dashes.
function outlineLooks() {
  const own = D.outlines.filter((o) => o.experiment), others = D.outlines.filter((o) => !o.experiment);
  return D.outlines.map((o) => o.experiment
    ? {width: 3, color: ink, type: ["solid", "dashed", "dotted"][own.indexOf(o) % 3]}
    : {width: 1.7, color: palette[others.indexOf(o) % palette.length]});
}

// The outlines over each other, in millimetres, with one scale for width and height.
function outlineChart() {
  const all = D.outlines.flatMap((o) => o.points);
  const reach = Math.max(D.plate_mm / 2, ...all.map((p) => Math.abs(p[0]))) * 1.05;
  const top = Math.max(...all.map((p) => p[1])) * 1.08;
  return chart("outlines", "Outlines at half intensity",
      "The highest powder above each point of the plate. Width and height are drawn to one scale.", (width) => {
    const inner = width - margins.left - margins.right, looks = outlineLooks();
    return {
      height_px: Math.round(inner * top / (2 * reach)) + margins.top + margins.bottom + 26,
      grid: {...margins, top: margins.top + 26},
      legend: {...legendStyle, icon: "roundRect", itemHeight: 4},
      tooltip: {...tooltipStyle, formatter: (e) => lines([e.seriesName,
        format(e.data[0]) + " mm from the centre, " + format(e.data[1]) + " mm high"])},
      xAxis: valueAxis("distance from the plate's centre (mm)", {min: -reach, max: reach, nameGap: 28,
        axisLabel: {color: soft, fontSize: 12, formatter: tick, showMinLabel: false, showMaxLabel: false}}),
      yAxis: valueAxis("height (mm)", {min: 0, max: top,
        axisLabel: {color: soft, formatter: tick, showMaxLabel: false}}),
      series: [
        ...D.outlines.map((o, k) => ({type: "line", name: o.title, data: o.points, symbol: "none",
          connectNulls: false, lineStyle: looks[k], itemStyle: {color: looks[k].color}, triggerLineEvent: true})),
        {type: "line", data: [[-D.plate_mm / 2, 0], [D.plate_mm / 2, 0]], symbol: "none", silent: true,
         lineStyle: {color: axisLine, width: 5}},
      ],
    };
  }).figure;
}
