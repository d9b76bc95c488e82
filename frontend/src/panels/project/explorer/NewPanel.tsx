import { panelPath } from "../../../logic/project/panelFiles";
import { createPanel } from "../../../store/operator/panels";
import { useDocuments } from "../../../store/project/documents";
import { t } from "../../../text";
import { AskName } from "../../../ui/AskName";

/** Asks for the name of an operator panel and makes it. */
export function NewPanel({ onClose }: { onClose: () => void }) {
  const files = useDocuments((documents) => documents.files);
  return (
    <AskName
      title={t("operator.new")}
      about={t("operator.new.about")}
      label={t("operator.new.name")}
      action={t("create")}
      onName={async (name) => {
        const path = panelPath(name, files);
        if (path === null) throw new Error(t("operator.new.badname"));
        await createPanel(path);
      }}
      onClose={onClose}
    />
  );
}
