import type { Locator, Page } from '@playwright/test';

/** The tree at the left: programs, instances, memory. */
export class Explorer {
  constructor(private readonly page: Page) {}

  get tree(): Locator {
    return this.page.getByRole('tree', { name: 'Explorer' });
  }

  item(name: string): Locator {
    return this.tree.getByRole('treeitem', { name, exact: true });
  }

  async newFile(name: string): Promise<void> {
    await this.page.getByRole('button', { name: 'New file' }).click();
    const dialog = this.page.getByRole('dialog', { name: 'New file' });
    await dialog.getByRole('textbox', { name: 'Name' }).fill(name);
    await dialog.getByRole('button', { name: 'Create' }).click();
  }
}
