import type { IDockviewHeaderActionsProps } from "dockview-react";
import { useEffect, useState } from "react";
import { topicOf } from "../logic/page/help";
import { showHelp } from "../store/page/help";
import { pageOf } from "../store/page/navigate";
import { t } from "../text";
import { Icon } from "../ui/Icon";
import { IconButton } from "../ui/IconButton";
import { fileOf } from "./layout";
import { canPopOut, popOut } from "./popOut";

/** The end of a tab strip: a window of its own for the tab in front; for a page the whole dock, or the other panels back. */
export function PageEnd({ activePanel, containerApi, panels, group }: IDockviewHeaderActionsProps) {
  const [wide, setWide] = useState(() => group.api.isMaximized());
  useEffect(() => {
    const change = containerApi.onDidMaximizedGroupChange(() => setWide(group.api.isMaximized()));
    return () => change.dispose();
  }, [containerApi, group]);
  // A drawing, or a text, may need the room of the other panels, too.
  const page = panels.some((panel) => (pageOf(panel.id) && panel.id !== "help") || fileOf(panel.id) !== undefined);
  return (
    <span className="pageend">
      {activePanel && activePanel.id !== "help" && (
        <IconButton
          icon="help"
          label={t("help.of", { panel: activePanel.title ?? "" })}
          hint="F1"
          small
          onClick={() => showHelp(topicOf(activePanel.id))}
        />
      )}
      {activePanel && canPopOut(activePanel.id) && (
        <IconButton icon="popout" label={t("popout.do")} small onClick={() => popOut(activePanel)} />
      )}
      {!wide && !page ? null : wide ? (
        <button
          type="button"
          className="btn quiet sm"
          aria-label={t("sweep.narrow")}
          title={t("sweep.narrow")}
          onClick={() => containerApi.exitMaximizedGroup()}
        >
          <Icon name="layout" small />
          {t("sweep.narrow.word")}
        </button>
      ) : (
        <IconButton icon="fit" label={t("sweep.widen")} small onClick={() => group.api.maximize()} />
      )}
    </span>
  );
}
