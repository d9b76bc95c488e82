/** Requests that must not overtake each other, such as two saves of one file: the second needs the version that the first one makes. */

/** A queue for each name: what is asked for begins once what was asked for before it has ended. */
export function inTurn(): <T>(name: string, work: () => Promise<T>) => Promise<T> {
  const last = new Map<string, Promise<unknown>>();
  return (name, work) => {
    const before = last.get(name);
    const mine = before ? before.then(work, work) : work();
    last.set(name, mine);
    const end = () => last.get(name) === mine && last.delete(name);
    mine.then(end, end);
    return mine;
  };
}
