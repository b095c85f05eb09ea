// SPDX-License-Identifier: GPL-3.0-or-later
// Reads the motion of a run, which stands in few characters in the page's data.

const kDigits = Object.fromEntries([..."ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-_"].map((c, i) => [c, i]));

/** Numbers of which the second differences are written in digits of five bits, the lowest first. */
function unpackNumbers({ from, unit, text }) {
  const list = [];
  let last = 0, before = 0, number = 0, place = 1;
  for (const c of text) {
    const digit = kDigits[c];
    number += (digit % 32) * place;
    place *= 32;
    if (digit >= 32) continue;
    const step = (number % 2 ? -(number + 1) / 2 : number / 2) + 2 * last - before;
    [before, last, number, place] = [last, step, 0, 1];
    list.push(from + step * unit);
  }
  return list;
}

/** Both axes, three numbers for each time. The component that is left out is what the length of 1 leaves. */
function unpackAxes({ count, dropped, sign, ref, off }) {
  const first = ref.map(unpackNumbers), apart = off.map(unpackNumbers), axes = { ref_axis_L: [], axis_L: [] };
  for (let i = 0; i < count; ++i) {
    for (const [name, share] of [["ref_axis_L", 0], ["axis_L", 1]]) {
      const known = first.map((list, k) => list[i] + share * apart[k][i]);
      if (dropped < 3) known.splice(dropped, 0, sign * Math.sqrt(Math.max(0, 1 - known[0] ** 2 - known[1] ** 2)));
      axes[name].push(...known);
    }
  }
  return axes;
}

/** Vectors whose components are packed one by one, as one list. */
function unpackVectors(components) {
  const lists = components.map(unpackNumbers);
  return (lists[0] ?? []).flatMap((_, i) => lists.map((list) => list[i]));
}

/** The page's data with the motion in full. */
function unpacked(data) {
  const { times, axes, vectors } = data.packed ?? {};
  if (!times) return data;
  const t_s = Array.isArray(times) ? times :
    Array.from({ length: times.count }, (_, i) => times.from + ((times.to - times.from) * i) / (times.count - 1));
  const lists = Object.entries(vectors ?? {}).map(([name, components]) => [name, unpackVectors(components)]);
  return { ...data, t_s, ...(axes ? unpackAxes(axes) : {}), ...Object.fromEntries(lists) };
}
