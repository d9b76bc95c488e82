import { ONLY } from "../../../logic/watch/watchsort";
import { setFilter, useWatchList } from "../../../store/watch/watchlist";
import { t } from "../../../text";
import { Icon } from "../../../ui/Icon";
import { IconButton } from "../../../ui/IconButton";
import { MenuButton } from "../../../ui/Menu";

/** Filters the rows by text and by state, and says how many remain. */
export function FilterBar({ shown, total, onClose }: { shown: number; total: number; onClose: () => void }) {
  const { text, only } = useWatchList((list) => list.filter);
  function close(): void {
    setFilter({ text: "", only: "all" });
    onClose();
  }
  return (
    <div className="sub watchfilter" role="search">
      <span className="inp sm">
        <Icon name="search" small />
        <input
          // biome-ignore lint/a11y/noAutofocus: it was opened for typing
          autoFocus
          aria-label={t("watch.filter.text")}
          placeholder={t("watch.filter.text")}
          value={text}
          spellCheck={false}
          onChange={(event) => setFilter({ text: event.target.value })}
          onKeyDown={(event) => {
            if (event.key === "Escape") close();
          }}
        />
      </span>
      <MenuButton
        label={t("watch.filter.only", { only: t(`watch.only.${only}`) })}
        items={() =>
          ONLY.map((value) => ({
            label: t(`watch.only.${value}`),
            checked: value === only,
            onSelect: () => setFilter({ only: value }),
          }))
        }
      >
        {t(`watch.only.${only}`)}
        <Icon name="chev-d" small />
      </MenuButton>
      <span className="faint" role="status">
        {t("watch.filter.shown", { shown, total })}
      </span>
      <span className="grow" />
      <IconButton icon="x" small label={t("watch.filter.close")} onClick={close} />
    </div>
  );
}
