// What programs take of the machine's memory, by /proc.
import { readFileSync, readdirSync } from 'node:fs';

/** A process and those that it started, megabytes that are theirs. */
export function memoryOf(pid) {
  const parents = new Map(readdirSync('/proc').filter((name) => /^\d+$/.test(name)).flatMap((name) => {
    try {
      return [[Number(name), Number(/\) \S (\d+)/.exec(readFileSync(`/proc/${name}/stat`, 'utf8'))[1])]];
    } catch {
      return []; // it has ended
    }
  }));
  const isOf = (id) => id === pid || (parents.has(id) && parents.get(id) > 1 && isOf(parents.get(id)));
  return [...parents.keys()].filter(isOf).reduce((sum, id) => {
    try {
      return sum + Number(/^Pss: +(\d+)/m.exec(readFileSync(`/proc/${id}/smaps_rollup`, 'utf8'))?.[1] ?? 0) / 1024;
    } catch {
      return sum;
    }
  }, 0);
}
