// A cell of more than two dimensions, cut where the puck is: what a map of two axes shows of it.

type Point = number[];

/** Where segments between points cross the plane on which an axis has a value. */
function cut(points: Point[], axis: number, value: number): Point[] {
  const found: Point[] = [];
  for (const [i, a] of points.entries()) {
    const from = a[axis]! - value;
    if (from === 0) found.push(a);
    for (const b of points.slice(i + 1)) {
      const to = b[axis]! - value;
      if (from * to < 0) found.push(a.map((x, k) => x + ((b[k]! - x) * from) / (from - to)));
    }
  }
  return found;
}

const cross = (o: Point, a: Point, b: Point): number => (a[0]! - o[0]!) * (b[1]! - o[1]!) - (a[1]! - o[1]!) * (b[0]! - o[0]!);

/** Andrew's monotone chain. */
function hull(points: Point[]): Point[] {
  const sorted = [...points].sort((a, b) => a[0]! - b[0]! || a[1]! - b[1]!);
  const chain = (order: Point[]) => {
    const side: Point[] = [];
    for (const point of order) {
      while (side.length > 1 && cross(side.at(-2)!, side.at(-1)!, point) <= 0) side.pop();
      side.push(point);
    }
    return side.slice(0, -1);
  };
  return sorted.length < 3 ? sorted : [...chain(sorted), ...chain(sorted.reverse())];
}

/** The polygon, on the first two axes, of the convex hull of `corners` at the place's values on all others. */
export function sliceOf(corners: Point[], place: Point): Point[] {
  let points = corners;
  for (let axis = 2; axis < place.length; ++axis) points = cut(points, axis, place[axis]!);
  return hull(points);
}

/** How far a place is from the slice, as a share of the axes' ranges: 0 on it. */
export function awayFrom(at: Point, place: Point, ranges: number[]): number {
  let square = 0;
  for (let axis = 2; axis < place.length; ++axis) square += ((at[axis]! - place[axis]!) / (ranges[axis] || 1)) ** 2;
  return Math.sqrt(square);
}
