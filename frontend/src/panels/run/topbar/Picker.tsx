import { useState } from "react";
import { showCompare } from "../../../store/past/comparisons";
import { chooseInstance, chooseProject, refreshApp, useBench } from "../../../store/plc/bench";
import { showInstances } from "../../../store/plc/instances";
import { usePlc } from "../../../store/plc/plc";
import { canChooseFolder, chooseFolder } from "../../../store/project/folderOut";
import { dropArchive, exportProject, useDropped } from "../../../store/project/newProject";
import { unsavedPaths } from "../../../store/project/unsaved";
import { openVersions } from "../../../store/project/versions";
import { openTraceImport } from "../../../store/verify/traceImport";
import { openVerifyRecords } from "../../../store/verify/verifyRecords";
import { t } from "../../../text";
import { Icon } from "../../../ui/Icon";
import { MenuButton, type MenuItem } from "../../../ui/Menu";
import type { AppInfo, Project } from "../../../wire/types";
import { FolderOut } from "./FolderOut";
import { NewInstance } from "./NewInstance";
import { NewProject } from "./NewProject";
import { XmlOut } from "./XmlOut";

/** What an export takes. */
function asSaved(): string {
  const count = unsavedPaths().length;
  return count === 0 ? t("picker.export.hint") : t("picker.export.hint.unsaved", { count });
}

type Asking = "project" | "instance" | "xml" | FileSystemDirectoryHandle | null;

/** Chooses the project and the virtual PLC that this browser shows. */
export function Picker() {
  const { app, project, instance } = useBench();
  const [asking, setAsking] = useState<Asking>(null);
  const dropped = useDropped(({ archive }) => archive);
  // Of the PLC it is what it runs: the project may have a newer version.
  const runs = usePlc(({ state }) => state?.program_version);
  const model = instance?.model ?? project?.model ?? "";
  return (
    <>
      <MenuButton
        label={t("picker.label")}
        title={[project?.name, instance?.name].filter(Boolean).join(" / ") || t("picker.label")}
        className="picker"
        items={() => (app ? itemsOf(app, project, instance?.id, setAsking) : [])}
        onOpen={() => void refreshApp()}
      >
        <span className="two">
          <span className="names">
            <span className="cut">{project?.name ?? t("picker.none")}</span>
            {instance && <span className="cut">{` / ${instance.name}`}</span>}
          </span>
          <span className="cut">{project ? t("picker.about", { model, version: runs ?? project.version }) : ""}</span>
        </span>
        <Icon name="chev-d" />
      </MenuButton>
      {(asking === "project" || dropped) && (
        <NewProject
          key={dropped?.name}
          dropped={dropped}
          onClose={() => {
            dropArchive(null);
            setAsking(null);
          }}
        />
      )}
      {asking && typeof asking === "object" && project && (
        <FolderOut project={project} folder={asking} onClose={() => setAsking(null)} />
      )}
      {asking === "xml" && project && <XmlOut project={project} onClose={() => setAsking(null)} />}
      {asking === "instance" && project && <NewInstance project={project} onClose={() => setAsking(null)} />}
    </>
  );
}

async function askForFolder(ask: (folder: FileSystemDirectoryHandle) => void): Promise<void> {
  const folder = await chooseFolder();
  if (folder) ask(folder);
}

function itemsOf(
  app: AppInfo,
  project: Project | null,
  instance: number | undefined,
  ask: (what: Asking) => void,
): MenuItem[] {
  const instances = app.instances.map(
    (known): MenuItem => ({
      label: `${known.project.name} / ${known.name}`,
      end: ` / ${known.name}`,
      hint: known.model,
      checked: known.id === instance,
      onSelect: () => void chooseInstance(known),
    }),
  );
  const idle = app.projects.filter((known) => !app.instances.some((other) => other.project.id === known.id));
  const projects = idle.map(
    (known): MenuItem => ({
      label: known.name,
      hint: t("picker.noinstance"),
      checked: known.id === project?.id && instance === undefined,
      onSelect: () => void chooseProject(known),
    }),
  );
  return [
    ...instances,
    ...projects,
    {
      label: t("compare.runs"),
      icon: "swap",
      separated: true,
      disabled: instance === undefined,
      onSelect: () => showCompare(),
    },
    { label: t("instances.show"), icon: "list", onSelect: () => showInstances(true) },
    {
      label: t("picker.newinstance"),
      icon: "plc",
      disabled: project === null,
      onSelect: () => ask("instance"),
    },
    { label: t("picker.newproject"), icon: "plus", onSelect: () => ask("project") },
    {
      label: t("versions.open"),
      icon: "branch",
      disabled: project === null,
      onSelect: () => void openVersions(),
    },
    {
      label: t("picker.export"),
      icon: "export",
      hint: asSaved(),
      disabled: project === null,
      onSelect: () => project && void exportProject(project),
    },
    {
      label: t("xmlout.menu"),
      icon: "export",
      hint: asSaved(),
      disabled: project === null,
      onSelect: () => ask("xml"),
    },
    ...(canChooseFolder()
      ? [
          {
            label: t("folderout.menu"),
            icon: "folder",
            hint: asSaved(),
            disabled: project === null,
            onSelect: () => void askForFolder(ask),
          } satisfies MenuItem,
        ]
      : []),
    {
      label: t("import.trace"),
      icon: "import",
      separated: true,
      disabled: instance === undefined,
      onSelect: () => openTraceImport(),
    },
    { label: t("verify.records"), icon: "list", disabled: project === null, onSelect: openVerifyRecords },
  ];
}
