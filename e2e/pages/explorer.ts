import { expect, type Locator, type Page } from '@playwright/test';

/** The tree on the left: programs, instances, memory. */
export class Explorer {
  constructor(private readonly page: Page) {}

  get tree(): Locator {
    return this.page.getByRole('tree', { name: 'Explorer' });
  }

  item(name: string): Locator {
    return this.tree.getByRole('treeitem', { name, exact: true });
  }

  async deleteFile(name: string, file: string): Promise<void> {
    await this.item(name).click({ button: 'right' });
    await this.page.getByRole('menuitem', { name: `Delete ${file}…` }).click();
    const dialog = this.page.getByRole('dialog', { name: `Delete ${file}` });
    await dialog.getByRole('button', { name: 'Delete', exact: true }).click();
    await expect(dialog).toBeHidden();
  }

  /** Adds files of this computer, as with the button above the tree. */
  async addFiles(...files: { name: string; text: string | Buffer }[]): Promise<void> {
    const chooser = this.page.waitForEvent('filechooser');
    await this.page.getByRole('button', { name: 'Add files from this computer' }).click();
    const chosen = files.map(({ name, text }) => ({ name, mimeType: 'text/plain', buffer: Buffer.from(text) }));
    await (await chooser).setFiles(chosen);
  }

  async newFile(name: string): Promise<void> {
    await this.page.getByRole('button', { name: 'New file' }).click();
    const dialog = this.page.getByRole('dialog', { name: 'New file' });
    await dialog.getByRole('textbox', { name: 'Name' }).fill(name);
    await dialog.getByRole('button', { name: 'Create' }).click();
  }
}
