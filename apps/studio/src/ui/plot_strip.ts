// A plot over time along the bottom, as wide as its box, drawn anew as frames pass and when colours change.
import { useEffect, useRef } from 'preact/hooks';
import { effect } from '@preact/signals';
import type uPlot from 'uplot';
import { frameCount } from '../session';
import { isDark } from '../view/theme';

/** For the box that the plot is made in. `show` fills it, at most every `every` ms unless `isEmpty`. */
export function usePlotStrip(make: (box: HTMLElement) => uPlot, show: (plot: uPlot) => void, every: number, isEmpty = () => false) {
  const box = useRef<HTMLDivElement>(null);
  useEffect(() => {
    const element = box.current!;
    const plot = make(element);
    const fit = new ResizeObserver(() => {
      if (element.clientWidth > 0 && element.clientHeight > 0)
        plot.setSize({ width: element.clientWidth, height: element.clientHeight });
    });
    fit.observe(element);
    let last = 0;
    const stop = effect(() => {
      void frameCount.value;
      const now = performance.now();
      if (element.clientHeight === 0 || (now - last < every && !isEmpty())) return;
      last = now;
      plot.batch(() => show(plot));
    });
    const repaint = effect(() => {
      void isDark.value;
      requestAnimationFrame(() => plot.redraw());
    });
    return () => {
      stop();
      repaint();
      fit.disconnect();
      plot.destroy();
    };
  }, []);
  return box;
}
