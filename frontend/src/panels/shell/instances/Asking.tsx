import { useState } from "react";
import { copyName } from "../../../logic/plc/instances";
import { readScan } from "../../../logic/plc/timeline";
import { createInstance } from "../../../store/plc/bench";
import { branch, changeInstance, useInstances } from "../../../store/plc/instances";
import { t } from "../../../text";
import { AskName } from "../../../ui/AskName";
import { Field } from "../../../ui/Field";
import type { Instance, Project } from "../../../wire/types";
import { DeleteInstance } from "./DeleteInstance";
import { ImportRun } from "./ImportRun";
import { Limits } from "./Limits";

export type Question =
  | { ask: "import" }
  | { ask: "new"; project: Project }
  | { ask: "clone" | "branch" | "rename" | "limits" | "delete"; instance: Instance };

interface Props {
  question: Question;
  onClose: () => void;
}

/** The dialog that a button of the list opens. */
export function Asking({ question, onClose }: Props) {
  switch (question.ask) {
    case "new":
      return <New project={question.project} onClose={onClose} />;
    case "import":
      return <ImportRun onClose={onClose} />;
    case "clone":
      return <Clone instance={question.instance} onClose={onClose} />;
    case "branch":
      return <BranchAt instance={question.instance} onClose={onClose} />;
    case "rename":
      return <Rename instance={question.instance} onClose={onClose} />;
    case "limits":
      return <Limits instance={question.instance} onClose={onClose} />;
    case "delete":
      return <DeleteInstance instance={question.instance} onClose={onClose} />;
  }
}

function New({ project, onClose }: { project: Project; onClose: () => void }) {
  return (
    <AskName
      title={t("newinstance.title", { project: project.name })}
      about={t("newinstance.about", { model: project.model })}
      label={t("newinstance.name")}
      action={t("create")}
      onName={(name) => createInstance(project, name)}
      onClose={onClose}
    />
  );
}

interface OneProps {
  instance: Instance;
  onClose: () => void;
}

function Clone({ instance, onClose }: OneProps) {
  const initial = useFreeName(instance);
  return (
    <AskName
      title={t("instances.clone.title", instance)}
      about={t("instances.clone.about", instance)}
      label={t("instances.name")}
      action={t("create")}
      initial={initial}
      onName={async (name) => void (await branch(instance, name, null))}
      onClose={onClose}
    />
  );
}

function BranchAt({ instance, onClose }: OneProps) {
  const initial = useFreeName(instance);
  const [scan, setScan] = useState(String(instance.state.scan));

  async function make(name: string): Promise<void> {
    const at = readScan(scan);
    if (at === null) throw new Error(t("run.scans.bad"));
    await branch(instance, name, at);
  }

  return (
    <AskName
      title={t("instances.branch.title", instance)}
      about={t("instances.branch.about", instance)}
      label={t("instances.name")}
      action={t("create")}
      initial={initial}
      onName={make}
      onClose={onClose}
    >
      <Field label={t("instances.branch.scan")} value={scan} onChange={setScan} mono />
    </AskName>
  );
}

function Rename({ instance, onClose }: OneProps) {
  return (
    <AskName
      title={t("instances.rename.title", instance)}
      label={t("instances.name")}
      action={t("instances.rename.do")}
      initial={instance.name}
      onName={(name) => changeInstance(instance, { name })}
      onClose={onClose}
    />
  );
}

/** The instance as it was when the dialog opened: the list below is still being updated. */
function useFreeName(instance: Instance): string {
  const [name] = useState(() =>
    copyName(
      instance.name,
      useInstances.getState().all.map((known) => known.name),
    ),
  );
  return name;
}
