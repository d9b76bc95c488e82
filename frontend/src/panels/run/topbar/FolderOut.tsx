import { useEffect, useState } from "react";
import { messageOf } from "../../../logic/format/messageOf";
import type { FolderPlan } from "../../../logic/project/folderOut";
import { planFolder, writeFolder } from "../../../store/project/folderOut";
import { t } from "../../../text";
import { FileList, FileLists } from "../../../ui/FileLists";
import { FormDialog } from "../../../ui/FormDialog";
import { Trouble } from "../../../ui/Trouble";
import type { Project } from "../../../wire/types";

interface Props {
  project: Project;
  folder: FileSystemDirectoryHandle;
  onClose: () => void;
}

/** Says which files a folder of this computer would get, and writes them. */
export function FolderOut({ project, folder, onClose }: Props) {
  const [plan, setPlan] = useState<FolderPlan | null>(null);
  const [trouble, setTrouble] = useState<string | null>(null);
  const [written, setWritten] = useState(false);

  useEffect(() => {
    planFolder(project, folder).then(setPlan, (error: unknown) => setTrouble(messageOf(error)));
  }, [project, folder]);

  const count = plan ? plan.fresh.length + plan.changed.length : 0;
  const isDone = written || (plan !== null && count === 0);

  async function submit(): Promise<boolean> {
    if (isDone || plan === null) return isDone;
    await writeFolder(folder, plan);
    setWritten(true);
    return false;
  }

  return (
    <FormDialog
      title={t("folderout.title", { folder: folder.name })}
      about={t("folderout.about")}
      width={520}
      submit={isDone || !plan ? t("close") : t("folderout.write", { count })}
      disabled={plan === null}
      onSubmit={submit}
      onClose={onClose}
    >
      <Trouble text={trouble} />
      {!plan && !trouble && <p role="status">{t("folderout.comparing")}</p>}
      {plan && isDone && <p role="status">{written ? t("folderout.written", { count }) : t("folderout.nothing")}</p>}
      {plan && !isDone && (
        <FileLists>
          <FileList title={t("folderout.changed")} files={plan.changed} />
          <FileList title={t("folderout.fresh")} files={plan.fresh} />
          {plan.same.length > 0 && <p>{t("folderout.same", { count: plan.same.length })}</p>}
        </FileLists>
      )}
    </FormDialog>
  );
}
