import { askBuildMessage, useBuildMessage } from "../../../store/project/buildMessage";
import { build } from "../../../store/project/documents";
import { t } from "../../../text";
import { AskName } from "../../../ui/AskName";

/** Asks for the message of a build, which is kept with its version, and builds. */
export function BuildMessage() {
  const asking = useBuildMessage((state) => state.asking);
  if (!asking) return null;
  return (
    <AskName
      title={t("build.saying.title")}
      about={t("build.saying.about")}
      label={t("git.message")}
      action={t("build")}
      missing={t("build.saying.missing")}
      onName={async (message) => void build(false, null, message)}
      onClose={() => askBuildMessage(false)}
    />
  );
}
