/** The tasks of the program as it is edited: how often each runs, with which priority, and what it runs. */
import { interval } from "../../../logic/format/numbers";
import { openFile } from "../../../store/page/navigate";
import { t } from "../../../text";
import type { TreeRow } from "../../../ui/Tree";
import type { Pou, Task } from "../../../wire/types";
import { type Folding, folder } from "./folding";

export function taskRows(tasks: readonly Task[], pous: readonly Pou[], folding: Folding): TreeRow[] {
  if (tasks.length === 0) return [];
  const row = folder(folding, "tasks", t("explorer.tasks"), tasks.length);
  return folding.isOpen("tasks") ? [row, ...tasks.flatMap((task) => oneTask(task, pous))] : [row];
}

function oneTask(task: Task, pous: readonly Pou[]): TreeRow[] {
  const { name, file, line, programs } = task;
  const when = whenOf(task);
  const priority = t("explorer.task.priority", { priority: task.priority });
  const where = file === "" ? t("explorer.task.free") : `${file}:${line}`;
  return [
    {
      key: `task:${name}`,
      level: 1,
      icon: "task",
      label: name,
      name,
      meta: <span className="whole">{`${when} · ${priority}`}</span>,
      title: [name, when, priority, where].join(" · "),
      // Without a CONFIGURATION nothing declares it.
      onActivate: () => (file === "" ? openPou(programs[0]?.pou, pous) : openFile(file, line)),
    },
    ...programs.map((program): TreeRow => {
      const same = program.name.toUpperCase() === program.pou.toUpperCase();
      return {
        key: `task:${name}:${program.name}`,
        level: 2,
        icon: "program",
        label: program.name,
        name: program.name,
        ...(same ? {} : { meta: program.pou }),
        title: t("explorer.task.runs", { task: name, program: program.name, pou: program.pou }),
        onActivate: () => openPou(program.pou, pous),
      };
    }),
  ];
}

function whenOf({ interval_ns, event }: Task): string {
  const every = interval_ns > 0 ? interval(interval_ns) : "";
  return [every, event ? t("explorer.task.event") : ""].filter(Boolean).join(", ");
}

function openPou(name: string | undefined, pous: readonly Pou[]): void {
  const found = pous.find((pou) => pou.name.toUpperCase() === name?.toUpperCase());
  if (found) openFile(found.file, found.line);
}
