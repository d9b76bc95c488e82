/** Back and forward through the places where the caret was, over all files. */
import { openFile, useNavigation } from "../page/navigate";
import { useDocuments } from "./documents";

interface Place {
  path: string;
  line: number;
  column: number;
}

/** Within so many lines the caret has not gone to a different place. */
const NEAR = 10;
const MOST = 50;

const back: Place[] = [];
const forward: Place[] = [];
let here: Place | null = null;
/** The place that is being gone to: a tab that comes to the front tells its old caret first. */
let going: Place | null = null;
let told = 0;
const TELLS = 2;
/** Whether that is a place from the lists, so that nothing is added to them; and whether the next one is. */
let returning = false;
let fromLists = false;

const isNear = (one: Place, other: Place) => one.path === other.path && Math.abs(one.line - other.line) < NEAR;

useDocuments.subscribe(({ project, active, cursor }, before) => {
  if (project !== before.project) {
    back.length = 0;
    forward.length = 0;
    here = null;
    return;
  }
  if (active === null || cursor === null || (active === before.active && cursor === before.cursor)) return;
  const now = { path: active, ...cursor };
  told += 1;
  if (going && !isNear(now, going) && told <= TELLS) return;
  if (here && !isNear(here, now) && !returning) {
    back.push(here);
    back.splice(0, back.length - MOST);
    forward.length = 0;
  }
  [going, returning] = [null, false];
  here = now;
});

useNavigation.subscribe(({ place }) => {
  [going, told, returning] = [place, 0, fromLists];
});

/** Alt+Left. */
export const goBack = () => go(back, forward);

/** Alt+Right. */
export const goForward = () => go(forward, back);

function go(from: Place[], to: Place[]): void {
  const { files } = useDocuments.getState();
  let target = from.pop();
  while (target && !files.some(({ path }) => path === target?.path)) target = from.pop(); // it was deleted
  if (!target) return;
  if (here) to.push(here);
  fromLists = true;
  openFile(target.path, target.line, target.column);
  fromLists = false;
}
