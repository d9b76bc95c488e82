import type { ReactNode } from "react";
import "./filelists.css";

/** Titled lists of files, which scroll together in a dialog. */
export const FileLists = ({ children }: { children: ReactNode }) => <div className="filelists">{children}</div>;

interface Props {
  title: string;
  files: readonly { path: string; why?: string }[];
}

/** One list: nothing where it is empty. */
export function FileList({ title, files }: Props) {
  if (files.length === 0) return null;
  return (
    <>
      <h3>{title}</h3>
      <ul aria-label={title}>
        {files.map(({ path, why }) => (
          <li key={path}>
            <span className="mono">{path}</span>
            {why && `: ${why}`}
          </li>
        ))}
      </ul>
    </>
  );
}
