import { type CSSProperties, useEffect } from "react";
import { grouped } from "../../../logic/format/numbers";
import { baseName, chosenFor } from "../../../logic/format/paths";
import type { BindingRow } from "../../../logic/watch/watchrows";
import { openFile } from "../../../store/page/navigate";
import { lookAtBinding, useBindings } from "../../../store/watch/bindings";
import { chooseSite, useWatchList } from "../../../store/watch/watchlist";
import { t } from "../../../text";
import { Icon } from "../../../ui/Icon";
import { MenuButton } from "../../../ui/Menu";
import type { Binding, BoundTo } from "../../../wire/types";
import { siteName, siteShown } from "./sites";

/** Below an in-out: how it is passed, by which call, when; and a choice of a different call for writing. */
export function BindingLine({ row, style, index }: { row: BindingRow; style: CSSProperties; index: number }) {
  const binding = useBindings((bindings) => bindings.of.get(row.path));
  useEffect(() => lookAtBinding(row.path), [row.path]);
  return (
    <div className="gr note binding" role="row" style={style} aria-rowindex={index + 2}>
      <span className="full" role="gridcell">
        {binding && <Told path={row.path} binding={binding} />}
      </span>
    </div>
  );
}

function Told({ path, binding }: { path: string; binding: Binding }) {
  const chosen = useWatchList((list) => chosenFor(list.sites, path));
  const site = siteShown(binding, chosen);
  const message = binding.message || site?.message || "";
  return (
    <>
      <span>{t(`binding.${binding.convention}`)}</span>
      {site && <Call site={site} />}
      {site && <span>{when(site)}</span>}
      {binding.sites.length > 1 && site && <span>{whichOf(binding, site)}</span>}
      {message && (
        <span className="st warning" title={message}>
          <Icon name="warning" />
          <span className="cut">{message}</span>
        </span>
      )}
      {binding.sites.length > 1 && <OtherCall path={path} binding={binding} shown={site} />}
    </>
  );
}

const when = ({ scan, last }: BoundTo) =>
  scan === null ? t(last ? "binding.last" : "binding.notlast") : t("binding.scan", { scan: grouped(scan) });

function whichOf({ sites }: Binding, site: BoundTo): string {
  const count = sites.length;
  return site.last ? t("binding.lastof", { count }) : t("binding.picked", { count });
}

function Call({ site }: { site: BoundTo }) {
  const place = `${baseName(site.file)}:${site.line}`;
  return (
    <span>
      {t("binding.call")}{" "}
      <button
        type="button"
        className="link mono"
        tabIndex={-1}
        title={t("binding.goto", { call: site.call, place: siteName(site) })}
        onClick={() => openFile(site.file, site.line, site.column)}
      >
        {place}
      </button>
    </span>
  );
}

function OtherCall({ path, binding, shown }: { path: string; binding: Binding; shown: BoundTo | undefined }) {
  return (
    <MenuButton
      label={t("binding.other.of", { path })}
      title={t("binding.other.about")}
      className="link"
      items={() =>
        binding.sites.map((site) => ({
          label: `${site.actual || t("binding.none")}${site.address ? ` (${site.address})` : ""}`,
          hint: `${site.call} ${baseName(site.file)}:${site.line}${site.last ? ` · ${t("binding.last")}` : ""}`,
          checked: site === shown,
          disabled: site.message !== "",
          onSelect: () => chooseSite(path, site.last ? null : siteName(site)),
        }))
      }
    >
      {t("binding.other")}
    </MenuButton>
  );
}
