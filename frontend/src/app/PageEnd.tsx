import type { IDockviewHeaderActionsProps } from "dockview-react";
import { useEffect, useState } from "react";
import { pageOf } from "../store/page/navigate";
import { t } from "../text";
import { Icon } from "../ui/Icon";
import { IconButton } from "../ui/IconButton";

/** The button at the end of a page's tab strip: gives the page the whole dock, or brings the other panels back. */
export function PageEnd({ containerApi, panels, group }: IDockviewHeaderActionsProps) {
  const [wide, setWide] = useState(() => group.api.isMaximized());
  useEffect(() => {
    const change = containerApi.onDidMaximizedGroupChange(() => setWide(group.api.isMaximized()));
    return () => change.dispose();
  }, [containerApi, group]);
  if (!wide && !panels.some((panel) => pageOf(panel.id))) return null;
  return (
    <span className="pageend">
      {wide ? (
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
